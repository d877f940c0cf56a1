"""A film that closes an opening, as an own flat part: a thin layer of soft rubber with the film on its outside.

Circular film clamped at its rim under pressure p: Hencky's problem (Hencky 1915, Zeitschrift für Mathematik und Physik
63, 311-317; Fichter 1997, NASA Technical Paper 3658, gives his series). Exact for moderate slopes:
Föppl's equations with the force per width N(r) along the radius and the slope w' = −p r / (2 N),

    N'' + 3 N' / r = −E h w'² / (2 r²),   a N'(a) + (1 − ν) N(a) = 0,

solved here as a boundary value problem; at ν = 0.3 the middle rises by 0.6536 a (p a / (E h))^(1/3). The mesh has a
hole of a fiftieth of the radius in the middle. Tolerance: 1 % for the mesh, the hole and the layer (0.3 % measured).

A chamber of a CAD part that is open below and closed by a flat body of its own: the body as a solid of the film's
moduli, or filled with rubber and a shell on its outside. Both bend alike. Tolerance: 8 % of the change of the volume,
because the shell lies on the outside of the film and the solid in its middle, and the film of half a millimeter has one
cell across (7.2 % measured).
"""

import numpy as np
import pytest
from netgen.occ import Box, Glue, Pnt
from scipy.integrate import solve_bvp

import meshes
import problems
import turgor as tg
from turgor.core.model.layers import as_solid
from turgor.units import GPa, kPa, mm

RADIUS, HOLE, YOUNG, NU, THICKNESS = 10 * mm, 0.02, 1 * GPa, 0.3, 0.05 * mm
PRESSURE = 18 * kPa


def hencky(nu: float) -> float:
    """Deflection of the middle over a (p a / (E h))^(1/3), by Föppl's equations in r / a, N / (p² a² E h)^(1/3)."""

    def equations(r, y):
        N, slope = y
        return np.vstack([slope, -3 * slope / r - 1 / (8 * N**2)])

    def ends(start, end):
        return np.array([start[1], end[1] + (1 - nu) * end[0]])  # the second: no hoop strain at the rim

    r = np.linspace(1e-4, 1, 400)
    guess = np.vstack([0.43 - 0.1 * r**2, -0.2 * r])
    result = solve_bvp(equations, ends, r, guess, tol=1e-8)
    assert result.success
    fine = np.linspace(1e-4, 1, 4000)
    return float(np.trapezoid(fine / (2 * result.sol(fine)[0]), fine))


def test_circular_film_under_pressure(record_verification):
    assert hencky(0.3) == pytest.approx(0.6536, abs=2e-4)  # as Hencky's series gives it
    mesh = meshes.tube_sector(HOLE * RADIUS, RADIUS, 0.2 * mm, (8, 5, 1))
    film = tg.Membrane(tg.Material(name="film", law=tg.laws.Hooke(E=YOUNG, nu=NU)), THICKNESS)
    cuts = [tg.supports.Symmetry("symmetry_x"), tg.supports.Symmetry("symmetry_y")]
    materials = {"body": problems.rubber(tg.laws.NeoHooke(C10=10 * kPa)), "z1": film}
    model = tg.Model(mesh, materials, [*cuts, tg.Fixed("outside")], [tg.Pressure("z0", PRESSURE)])
    solution = problems.solve(model, tg.Static(first_step=0.002))
    middle = mesh.points[:, 2] > 0.1 * mm
    middle &= np.hypot(mesh.points[:, 0], mesh.points[:, 1]) < 1.01 * HOLE * RADIUS
    rise = float(solution.states[-1].displacement[middle, 2].mean())
    got = rise / RADIUS / (PRESSURE * RADIUS / (YOUNG * THICKNESS)) ** (1 / 3)
    record_verification(
        claim="circular film clamped at its rim: rise of the middle over a (p a / (E h))^(1/3) [-]",
        source="Hencky 1915",
        expected=hencky(NU),
        got=got,
        tolerance="1 %",
    )
    assert got == pytest.approx(hencky(NU), rel=0.01)
    assert solution.iterations < 80


def chamber_on_a_film(folder, thickness: float):
    """A quarter of a block with a chamber of 8 mm that is open below, and a flat body that closes it, from STEP."""
    outer = 11.0
    block = Box(Pnt(0, 0, thickness), Pnt(outer, outer, 15)) - Box(Pnt(-1, -1, 0), Pnt(4, 4, 8 + thickness))
    path = folder / "chamber.step"
    Glue([block, Box(Pnt(0, 0, 0), Pnt(outer, outer, thickness))]).WriteStep(str(path))
    below = tg.cad.InBox((-1 * mm, -1 * mm, -1 * mm), (12 * mm, 12 * mm, (thickness + 0.01) * mm))
    sides = {"symmetry_x": "-x", "symmetry_y": "-y", "film_outside": "-z", "fixed": "+z"}
    return tg.cad.read_cad(
        path,
        regions={"film": below, "body": tg.cad.NearestTo((8 * mm, 8 * mm, 10 * mm))},
        faces={name: tg.cad.WithNormal(normal) for name, normal in sides.items()},
    )


@pytest.mark.slow
def test_flat_body_closes_an_open_chamber(tmp_path, record_verification):
    part = chamber_on_a_film(tmp_path, 0.5)
    assert part.cavity_volumes["cavity"] == pytest.approx(4 * 4 * 8e-9)
    mesh = tg.mesh(part, size=2 * mm, cells="tetrahedra")
    ecoflex = tg.from_library("ecoflex-00-30", record="ogden-moseley-2016")
    silk = tg.Material(name="silk", law=tg.laws.Hooke(E=4.1 * GPa, nu=0.3))
    as_shell = {"film": ecoflex, "film_outside": tg.Shell(silk, 0.5 * mm)}
    grown = []
    for film in ({"film": as_solid(silk)}, as_shell):
        model = tg.Model(mesh, {"body": ecoflex, **film}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 10 * kPa)])
        solution = problems.solve(model)
        volumes = tg.measure(solution, tg.cavity_volume, mesh_error=False).column("cavity_volume")
        grown.append(float(volumes[-1] - volumes[0]) * 1e9)
        assert solution.iterations < 20
    record_verification(
        claim="chamber open below, closed by a flat body of 0.5 mm as a shell: growth of the volume [mm³]",
        source="the flat body as a solid",
        expected=grown[0],
        got=grown[1],
        tolerance="8 %",
    )
    assert grown[1] == pytest.approx(grown[0], rel=0.08)
