"""A Cosserat rod bends as the elastica, with an error of fourth order in the length of its elements.

Problem: a cantilever of length and bending stiffness 1, nearly inextensible and unshearable, under a dead force at its
tip, a force that follows, a load along it, a moment that rolls it up, and a twist and curvature that make it a helix.
Reference: the elastica by shooting, integrated to 1e-11; the table of `beams/test_elastica` (six digits); a circle; a
helix in closed form. Tolerance: 16 elements 1e-5 of the length, the orders within 0.3 of four; a moment alone makes
constant strains, which the elements hold exactly, so round-off.
"""

import numpy as np
import pytest
from rod_cases import STIFF, bent, elastica, rates, slender
from scipy.spatial.transform import Rotation
from turgor.rods import LineLoad, Place, Plate, PlateForce, Rod, RodModel, RodSection, static

#: Load, and where the tip is, as in `beams/test_elastica`.
FOLLOWING = {4: (0.342746, 0.786168), 10: (-0.092123, 0.546983), 20: (0.275710, 0.330158)}
WEIGHT = {5: (1 - 0.153343, 0.495905), 20: (1 - 0.554768, 0.829881)}


def test_dead_force(record_verification):
    expected = elastica(10.0)
    meshes = (4, 8, 16, 32)
    tips = [bent([PlateForce(force=(0, 0, 10.0))], n)[-1, [0, 2]] for n in meshes]
    errors = [float(np.linalg.norm(tip - expected)) for tip in tips]
    record_verification("dead force P L²/EI = 10, 16 elements: tip (x, z)", "shooting", expected, tips[2], "1e-5")
    record_verification("the same, 4 to 32 elements: orders of the error", "theory", 4.0, rates(errors), "0.3")
    assert errors[2] < 1e-5
    assert rates(errors) == pytest.approx([4.0] * 3, abs=0.3)


def test_following_force(record_verification):
    shares = [load / 20 for load in FOLLOWING]
    tips = bent([PlateForce(force=(0, 0, 20.0), follows=True)], 32, at=shares)[:, [0, 2]]
    expected = list(FOLLOWING.values())
    claim = f"following force P L²/EI = {', '.join(map(str, FOLLOWING))}, 32 elements: tip (x, z)"
    record_verification(claim, "boundary value problem", expected, tips, "5e-6")
    assert tips == pytest.approx(np.array(expected), abs=5e-6)


def test_load_along_the_rod(record_verification):
    expected = list(WEIGHT.values())
    tips = [bent([LineLoad(force=(0, 0, 20.0))], n, at=[0.25, 1.0])[:, [0, 2]] for n in (4, 8, 16, 32, 64)]
    record_verification(
        f"dead load along the rod w L³/EI = {', '.join(map(str, WEIGHT))}, 16 elements: tip (x, z)",
        "boundary value problem", expected, tips[2], "1e-5",
    )  # fmt: skip
    assert tips[2] == pytest.approx(np.array(expected), abs=1e-5)
    errors = [np.linalg.norm(tip[-1] - tips[-1][-1]) for tip in tips[:-1]]
    record_verification("the same, 4 to 32 elements: orders of the error", "theory", 4.0, rates(errors), "0.4")
    assert rates(errors) == pytest.approx([4.0] * 3, abs=0.4)


def test_following_load_along_the_rod(record_verification):
    """Pressure on one side of a strip, the case of `beams/test_elastica`; here the error is of second order."""
    expected = (-0.291537, 0.652644)
    tips = [bent([LineLoad(force=(0, 0, 20.0), follows=True)], n, at=4)[-1, [0, 2]] for n in (8, 16, 32)]
    errors = [float(np.linalg.norm(tip - expected)) for tip in tips]
    record_verification(
        "following load along the rod q L³/EI = 20, 32 elements: tip (x, z)", "boundary value problem",
        expected, tips[-1], "1e-3",
    )  # fmt: skip
    assert errors[-1] < 1e-3
    assert rates(errors).min() > 1.8


def test_moment_rolls_up(record_verification):
    """One, and then two turns, in one step of Newton's method each."""
    for turns in (1, 2):
        load = PlateForce(moment=(0, 2 * np.pi * turns, 0))
        solution = static(RodModel(rods=[Rod(section=slender(), length=1.0, elements=8 * turns)], loads=[load]))
        record_verification(f"rolled up by {turns} turns: tip", "exact", (0, 0, 0), solution.tip[-1], "1e-10")
        assert solution.tip[-1] == pytest.approx([0, 0, 0], abs=1e-10)
        assert solution.response()["bending_angle"][-1] == pytest.approx(2 * np.pi * turns, rel=1e-10)


def test_helix(record_verification):
    """A moment of constant direction along the helix: curvature and twist are constant, the stiffness is not even."""
    section = RodSection.from_moduli(EA=STIFF, GA=STIFF, EI=[2.0, 0.5], GJ=0.7)
    strain = np.array([0, 0, 0, 3.0, 4.0, 0.0])
    rod = Rod(section=section, length=1.0, elements=5, rest_strain=strain)
    tip = static(RodModel(rods=[rod])).tip[-1]
    turn = np.array([3.0, 4.0, 0.0]) / 5
    along = np.array([1.0, 0, 0])
    expected = (
        np.sin(5) / 5 * along + (1 - np.cos(5)) / 5 * np.cross(turn, along)
        + (1 - np.sin(5) / 5) * (turn @ along) * turn
    )  # fmt: skip
    record_verification("helix by twist 3 and curvature 4: tip", "exact", expected, tip, "1e-12")
    assert tip == pytest.approx(expected, abs=1e-12)


def test_rigid_rotation_changes_nothing(record_verification):
    """A deformed rod is turned by 2.5 rad with its loads and its plate: forces and strains stay."""
    results = []
    for turn in (np.zeros(3), 2.5 * np.array([1.0, -2.0, 2.0]) / 3):
        R = Rotation.from_rotvec(turn).as_matrix()
        rod = Rod(section=RodSection.from_moduli(EA=200, GA=80, EI=[1.0, 2.0], GJ=0.8), length=1.0)
        loads = [PlateForce(force=R @ [0.5, 2, 3], moment=R @ [0.5, 0.2, 0.1])]
        plate = Plate(name="base", support="fixed", place=Place(position=(0.3, 0.1, -2), turn=turn))
        solution = static(RodModel(rods=[rod], loads=loads, plates=[plate]))
        shape = solution.shape()
        results.append((shape.strain, shape.force, (shape.position[-1] - shape.position[0]) @ R))
    change = max(float(np.abs(a - b).max()) for a, b in zip(*results, strict=True))
    record_verification("turned by 2.5 rad with its loads: change of strains and forces", "exact", 0.0, change, "1e-9")
    assert change < 1e-9


def test_path_does_not_matter(record_verification):
    """One force after the other, in both orders, and both at once: the same end."""
    early, late, both = ((0, 0), (0.5, 1), (1, 1)), ((0, 0), (0.5, 0), (1, 1)), ((0, 0), (1, 1))
    tips = []
    for first, second in ((early, late), (late, early), (both, both)):
        loads = [PlateForce(force=(0, 6, 0), history=first), PlateForce(force=(0, 0, 4), history=second)]
        tips.append(bent(loads, 8, at=10)[-1])
    record_verification("two forces in different orders: tip", "the same", tips[0], tips[1:], "1e-9")
    assert tips[1] == pytest.approx(tips[0], abs=1e-9)
    assert tips[2] == pytest.approx(tips[0], abs=1e-9)
