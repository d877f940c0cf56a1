"""Weight and inertia of films and of sheets that lie on a body.

Catenary: a strip of film without stretch hangs between ends that are 10 % closer than it is long, as a chain does: its
sag is a (cosh(l / 2a) − 1) with 2 a sinh(l / 2a) = L. Exact; tolerance 0.2 %, of 16 sides and of the toe and the share
in compression of the film, which make it 0.05 % longer. Its weight is exact.

Drumhead: a square membrane with the stress S in all directions has the frequencies √(S/ρ) √(m² + n²) / (2 a), exact
(Rayleigh, Theory of Sound, § 197). With Green's strain e + e²/2 that is S = E (e + e²/2) / (1 − ν). Quadratic sides:
the error of a frequency falls with the fourth power of their size.

Motion: started with a small velocity in its first mode, the drumhead is back where it was after a period. Even steps:
the error falls with the square of their length.

Free fall: g t²/2 of every node at any step, as the steps take an even acceleration exactly.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

import problems
import turgor as tg
from meshes import node_at
from turgor.core.engine.mass import total_mass
from turgor.units import GPa, mm

DENSITY, THICKNESS, YOUNG, NU = 1390.0, 50e-6, 4 * GPa, 0.3
G = 9.80665


def _film(compression=1.0, density=DENSITY):
    law = tg.laws.Hooke(E=YOUNG, nu=NU)
    return tg.Membrane(tg.Material(name="film", law=law, density=density), THICKNESS, compression=compression)


def _rectangle(length, width, edges, size):
    corners = ((0, 0, 0), (0, width, 0), (length, width, 0), (length, 0, 0))
    return tg.mesh(tg.bodies.Film(patches=(tg.bodies.Patch(corners=corners, faces=("film",), edges=edges),)), size=size)


def test_catenary(record_verification):
    length, width, closer = 400 * mm, 20 * mm, 0.1
    mesh = _rectangle(length, width, ("left", "side", "right", "symmetry_y"), length / 16)
    approach = tg.Displacement("right", lambda points, factor: -factor * closer * points * (1, 0, 0))
    supports = [tg.Fixed("side", "y"), tg.Fixed("left"), approach]
    weight = tg.Gravity((0, 0, -1), history="constant")
    state = problems.solve(tg.Model(mesh, {"film": _film(0.0)}, supports, [weight])).states[-1]
    half = (1 - closer) * length / 2
    a = brentq(lambda a: 2 * a * np.sinh(half / a) - length, 0.1 * length, 10 * length)
    whole = 2 * length * width * THICKNESS * DENSITY
    sag = -float(state.displacement[node_at(mesh, (length / 2, 0, 0)), 2])
    expected, got = [a * (np.cosh(half / a) - 1) / mm, whole * G], [sag / mm, 2 * float(state.nodal_force[:, 2].sum())]
    record_verification(
        claim="strip of film that hangs under its weight: sag [mm], force at its ends [N]",
        source="catenary, exact",
        expected=expected,
        got=got,
        tolerance="0.2 % and 1e-6",
    )
    assert got[0] == pytest.approx(expected[0], rel=2e-3)
    assert got[1] == pytest.approx(expected[1], rel=1e-6)
    assert total_mass(state.model) == pytest.approx(whole, rel=1e-12)


SIDE, STRETCH = 200 * mm, 2e-3
SPEED = np.sqrt(YOUNG / (1 - NU) * (STRETCH + STRETCH**2 / 2) / DENSITY)


def _drum(sides):
    """A quarter of a square drumhead that is stretched from the start."""
    half = SIDE / 2
    mesh = _rectangle(half, half, ("symmetry_x", "rim", "rim", "symmetry_y"), half / sides)
    return tg.Model(mesh, {"film": _film()}, [tg.Displacement("rim", lambda points, factor: STRETCH * points)], [])


def test_drumhead(record_verification):
    exact = SPEED / (2 * SIDE) * np.sqrt([2, 10])
    errors = []
    for sides in (2, 4):
        state = problems.solve(_drum(sides)).states[-1]
        modes = tg.natural_frequencies(state.model, state, count=2)
        errors.append(np.abs(modes.frequencies / exact - 1))
    record_verification(
        claim="square drumhead of film: frequencies of modes 11 and 13, 4 sides along a half [Hz]",
        source="Rayleigh, exact",
        expected=exact.tolist(),
        got=modes.frequencies.tolist(),
        tolerance="0.1 %, order 4 of the second one",
    )
    assert errors[1].max() < 1e-3
    assert np.log2(errors[0][1] / errors[1][1]) == pytest.approx(4, abs=0.4)
    assert modes.modal_mass[0] == pytest.approx(total_mass(state.model) / 4, rel=1e-3)


def test_motion_of_a_drumhead(record_verification):
    omega, model = np.pi * SPEED / SIDE * np.sqrt(2), _drum(2)
    duration, center, rise = 2 * np.pi / omega, node_at(model.mesh, (0, 0, 0)), 1e-3 * STRETCH * SIDE

    def start(points):
        shape = np.cos(np.pi * points[:, 0] / SIDE) * np.cos(np.pi * points[:, 1] / SIDE)
        return rise * omega * shape[:, None] * (0, 0, 1)

    errors = []
    for count in (24, 48):
        even = {"first_step": duration / count, "max_step": duration / count, "adaptive": False}
        motion = tg.Dynamic(duration=duration, velocity=start, spectral_radius=1.0, **even)
        stages = tg.Stages([tg.Stage("stretched"), tg.Stage("moving", procedure=motion)])
        errors.append(float(problems.solve(model, stages).states[-1].displacement[center, 2]) / rise)
    record_verification(
        claim="square drumhead after its period, 48 steps: displacement over its amplitude",
        source="exact",
        expected=0.0,
        got=errors[1],
        tolerance="0.02, order 2",
    )
    assert abs(errors[1]) < 0.02
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2, abs=0.2)


def test_free_fall_of_a_film():
    mesh = _rectangle(100 * mm, 50 * mm, ("left", "side", "right", "edge"), 50 * mm)
    model = tg.Model(mesh, {"film": _film(0.0)}, [], [tg.Gravity((0, 0, -1), history="constant")])
    state = problems.solve(model, tg.Dynamic(duration=0.1)).states[-1]
    assert state.displacement[:, 2] == pytest.approx(-0.005 * G, rel=1e-9)
    assert state.energies.kinetic == pytest.approx(total_mass(model) * (0.1 * G) ** 2 / 2, rel=1e-9)
