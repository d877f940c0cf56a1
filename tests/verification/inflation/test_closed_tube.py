"""V06: a thick tube with closed, free ends along its whole curve, past its limit point.

Problem: inner radius 5 mm, outer 7 mm; a quarter of a slice between a mirror plane and a plane that is moved along the
axis, filled with an incompressible fluid. The plane is moved as the exact solution says for the volume injected so far,
and what must come out is the pressure, the inner radius, and no force at the ends beyond that of the pressure there,
N = P π a², which is what makes the tube a closed one. Neo-Hookean (C10 = 0.12 MPa) and Yeoh (0.11, 0.02 MPa).
Exact: `exact.closed_tube`, which must reproduce `TABLE`; neo-Hookean maximum of 0.060525419 MPa at λ = 1.781009.
Source: Haughton and Ogden 1979.
Tolerance: pressure and inner stretch 0.2 %, the limit point's pressure 0.05 %, its stretch 0.002. Axial stretch: the
force left over, divided by what stretching the slice by its tabulated λz − 1 would cost, is below 5 %, so that λz − 1
is right within 5 %; from λ = 1.1 on, because below λz − 1 is some 1e-3 and the quotient depends on the mesh.
"""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import exact
import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.solvers.procedures.volume_control import VolumeControl

INNER, OUTER, HEIGHT = 5 * problems.MM, 7 * problems.MM, 1 * problems.MM
STRETCHES = (1.05, 1.10, 1.20, 1.30, 1.50, 1.75, 2.00, 2.50)
TABLE = {  # law, axial stretch, pressure [MPa], volume over that at rest
    "neo-Hookean": (
        problems.NEO_HOOKE,
        (1.0008432, 1.0033449, 1.0131585, 1.0290983, 1.0777649, 1.1650465, 1.2738923, 1.5285366),
        (0.01086377, 0.02011274, 0.03460525, 0.04484376, 0.05634691, 0.06048794, 0.05913444, 0.05173143),
        (1.10343, 1.21405, 1.45895, 1.73918, 2.42497, 3.56795, 5.09557, 9.55335),
    ),
    "Yeoh": (
        problems.YEOH,
        (1.0008434, 1.0033483, 1.0132050, 1.0292985, 1.0788535, 1.1684663, 1.2804791, 1.5416147),
        (0.009979426, 0.01858932, 0.03274174, 0.04401137, 0.06142334, 0.07824465, 0.09264851, 0.1188487),
        (1.10343, 1.21405, 1.45902, 1.73951, 2.42742, 3.57843, 5.12192, 9.63509),
    ),
}


def slice_mesh():
    """A quarter of a slice on a mirror plane; its cavity is open at the moved plane."""
    made = meshes.tube_sector(INNER, OUTER, HEIGHT, (2, 3, 1), kind=HEXAHEDRON)
    faces = {"symmetry_z" if name == "z0" else name: sides for name, sides in made.faces.items()}
    return tg.Mesh(points=made.points, cells=made.cells, regions=made.regions, faces=faces)


def inflate(name, stretches):
    """Path of the slice through the volumes at some inner stretches, and the exact axial stretches there."""
    law = TABLE[name][0]
    known = np.linspace(1.0, stretches[-1], 61)
    axial = np.array([1.0, *(exact.closed_tube(law, x, INNER, OUTER)[0] for x in known[1:])])
    ratio = known**2 * axial
    along = CubicSpline(ratio, axial)
    there = CubicSpline(known, ratio)(stretches)
    end = float(there[-1]) - 1

    def moved(points, load_factor):
        return points * [0, 0, float(along(1 + load_factor * end)) - 1]

    mesh = slice_mesh()
    model = problems.one_material(mesh, law, supports=[tg.Displacement("z1", moved, "z")])
    rest = np.pi * INNER**2 * 2 * HEIGHT  # both sides of the mirror plane
    asked = VolumeControl(
        volume=end * rest, at=tuple(float(x - 1) / end for x in there[:-1]), max_step=0.15, tolerance=1e-8
    )
    return problems.solve(model, asked), [(float(x) - 1) / end for x in there]


def over_force(state):
    """Force on the moved plane beyond that of the pressure, on the whole ring [N]."""
    radius = problems.mean_radius(state, "cavity", (0, 1))
    force = 4 * float(problems.reaction(state, "z1")[2])  # four quarters; the mirror image pulls the other way
    return force - state.pressures["cavity"] * np.pi * radius**2


@pytest.mark.parametrize("name", TABLE)
def test_exact_curve_reproduces_the_table(name):
    law, axial, pressures, volumes = TABLE[name]
    for stretch, *expected in zip(STRETCHES, axial, pressures, volumes, strict=True):
        z, pressure = exact.closed_tube(law, stretch, INNER, OUTER)
        assert z == pytest.approx(expected[0], abs=1e-7)
        assert pressure / problems.MPA == pytest.approx(expected[1], rel=5e-7)
        assert stretch**2 * z == pytest.approx(expected[2], rel=1e-5)


@pytest.mark.parametrize("name", TABLE)
def test_volume_control_follows_the_whole_table(name, record_verification):
    law, axial, pressures, volumes = TABLE[name]
    solution, factors = inflate(name, STRETCHES)
    states = [problems.state_at(solution, factor) for factor in factors]
    got = [state.pressures["cavity"] / problems.MPA for state in states]
    radius = [problems.mean_radius(state, "cavity", (0, 1)) / INNER for state in states]
    results = [tg.cavity_volume(state) / tg.cavity_volume(solution.states[0]) for state in states]
    section = np.pi * (OUTER**2 - INNER**2)
    cost = 3 * law.shear_modulus * section * (np.array(axial) - 1)
    left = np.array([over_force(state) for state in states]) / cost
    record_verification(
        claim=f"tube with closed ends, {name}, volume control: pressures at the tabulated volumes [MPa]",
        source="V06, exact",
        expected=list(pressures),
        got=got,
        tolerance="0.2 %",
    )
    record_verification(
        claim=f"tube with closed ends, {name}: inner stretch at the tabulated volumes",
        source="V06, exact",
        expected=list(STRETCHES),
        got=radius,
        tolerance="0.2 %",
    )
    record_verification(
        claim=f"tube with closed ends, {name}: force left at the ends over the cost of λz − 1, λ = 1.1 and more",
        source="V06, exact",
        expected=0.0,
        got=float(np.abs(left[1:]).max()),
        tolerance="0.05",
    )
    assert got == pytest.approx(pressures, rel=2e-3)
    assert radius == pytest.approx(STRETCHES, rel=2e-3)
    assert results == pytest.approx(volumes, rel=1e-3)
    assert np.abs(left[1:]).max() < 0.05


def test_the_limit_point_is_found(record_verification):
    solution, _ = inflate("neo-Hookean", (1.5, 2.0, 2.5))
    (limit,) = solution.limit_points
    stretch = problems.mean_radius(solution.states[limit.state], "cavity", (0, 1)) / INNER
    record_verification(
        claim="tube with closed ends, neo-Hookean: limit pressure [MPa], inner stretch there",
        source="V06, exact",
        expected=[0.060525419, 1.781009],
        got=[limit.pressure / problems.MPA, stretch],
        tolerance="0.05 %, 0.002",
    )
    assert limit.kind == "maximum"
    assert limit.pressure == pytest.approx(0.060525419 * problems.MPA, rel=5e-4)
    assert stretch == pytest.approx(1.781009, abs=2e-3)
