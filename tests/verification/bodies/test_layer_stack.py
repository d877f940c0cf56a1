"""A stack of layers that jams in a bent shape: loose, jammed and released (Narang, Vlassak and Howe 2018).

Problem: a cantilever of 6 layers, modeled as one body, is bent by a force at its end, jams there, and is bent further.
Exact: F L³ / 3 E I of a slender beam, with E I of six loose layers, then 36 times as much. Released, the loose layers
pull back and the jammed ones hold: of the first deflection 35/36 stays.
Tolerance: 2 % for the loose beam (the clamp keeps its section from narrowing), 1 % for ratios of deflections.
"""

import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.units import MPa, kPa, mm

STACK = tg.loads.LayerStack(
    layers=6, thickness=0.5 * mm, width=3 * mm, modulus=100 * MPa, pressure=70 * kPa, friction=0.5
)
LENGTH = 100 * mm


def test_a_stack_jams_in_a_bent_shape(record_verification):
    mesh = meshes.box((LENGTH, STACK.width, STACK.height), (8, 1, 1), kind=HEXAHEDRON)
    first = 0.01 * 3 * STACK.loose_stiffness / LENGTH**2  # the end moves by 1 % of the length

    def force(size):
        return tg.Traction("x1", (0, 0, size / STACK.width / STACK.height))

    loads = {
        "bend": force(first),
        "jam": STACK.hardening("body"),
        "more": force(5 * first),
        "release": force(0.0),
        "loose": tg.loads.Hardening("body", 0.0),
    }
    stages = tg.Stages([tg.Stage(name, tg.Static(first_step=1.0), loads=[load]) for name, load in loads.items()])
    model = tg.Model(mesh, {"body": problems.rubber(STACK.law)}, [tg.Fixed("x0", "xz"), tg.Fixed("y0", "y")], [])
    solution = problems.solve(model, stages)
    ends = {state.stage: state.displacement[mesh.face_nodes("x1"), 2].mean() for state in solution.states}
    exact = first * LENGTH**3 / 3 / STACK.loose_stiffness
    stiffer = (ends["more"] - ends["jam"]) / 4 / ends["bend"]
    for claim, expected, got, tolerance in (
        ("deflection of loose layers [mm]", exact / mm, ends["bend"] / mm, 0.02),
        ("flexibility of jammed layers over loose ones", 1 / 36, stiffer, 0.01),
        ("share of it that stays, jammed, without the force", 35 / 36, ends["release"] / ends["bend"], 0.01),
    ):  # fmt: skip
        record_verification(claim, "Narang, Vlassak and Howe (2018)", expected, got, f"{tolerance:.0%}")
        assert got == pytest.approx(expected, rel=tolerance)
    assert abs(ends["loose"]) < 1e-6 * ends["bend"]


def test_an_odd_stack_slips_later():
    """Its interfaces are not where the shear stress 3 V / 2 b H (1 − (2 y / H)²) is largest."""
    odd = tg.loads.LayerStack(layers=3, thickness=1e-3, width=1e-2, modulus=1e9, pressure=5e4, friction=0.4)
    y, height = 0.5e-3, 3e-3
    shear = 1.5 / 1e-2 / height * (1 - (2 * y / height) ** 2)
    assert odd.slip_force == pytest.approx(0.4 * 5e4 / shear)


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [({"layers": 1}, ["layers is 1", "2 to 1000"]), ({"friction": 0.0}, ["friction is 0", "above 0"])],
)
def test_what_is_no_stack_is_refused(wrong, facts):
    numbers = {"layers": 4, "thickness": 1e-3, "width": 1e-2, "modulus": 1e9, "pressure": 5e4, "friction": 0.4}
    with pytest.raises(tg.TurgorError) as error:
        tg.loads.LayerStack(**numbers | wrong)
    for fact in facts:
        assert fact in str(error.value)
