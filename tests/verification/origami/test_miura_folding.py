"""Miura tube: pressed together it gets narrower and taller as rigid folding does; vacuum folds it where it is steep.

Problem: a film of 0.3 mm and 20 MPa, two rows of sides of 20 mm and slanted edges of 12 mm. The rim slides in its
plane, and so does the end plate, a film without stiffness, so that nothing stops the tube from folding. It is pressed
by 2 %.
Reference: walls that stay flat (Schenk and Guest 2013, doi 10.1073/pnas.1217998110): the width 2 L and the height 2 H
of a rhombus follow the length S of a row, L √(b² − S²) = a b cos γ and L² + H² = a².
Tolerance: 8 % of both changes. Walls bend between folds that keep their angle; sides of 6 and of 3 mm differ by less.

Under vacuum the same tube shortens where its volume falls with its length, H / L > S / b, and lengthens otherwise: with
γ = 60° the sign changes at a fold angle of 45°. With a rigid rim and plate, tubes that are folded further at rest
shorten further, and so do those of more rows: signs, on coarse meshes.
"""

from functools import lru_cache

import numpy as np
import pytest

import problems
import turgor as tg
from turgor.units import MPa, deg, kPa, mm

FILM = tg.Material(name="film", law=tg.laws.Hooke(E=20 * MPa, nu=0.3))


def _solved(tube, thickness, supports, pressure=0.0):
    """Mesh and last state of a tube whose rhombi may change their shape, the end plate included."""
    mesh, corners = tg.mesh(tube, size=6 * mm), _corners(tube, 0)
    places = [tg.supports.NodesAt(f"corner {k}", box=(corner, corner)) for k, corner in enumerate(corners)]
    free = [tg.Fixed("fixed", "x"), tg.Fixed(places[0], "z"), tg.Fixed(places[1], "y"), tg.Fixed(places[3], "y")]
    sheets = {"film": tg.Shell(FILM, thickness), "tip": tg.Shell(FILM, 1e-3 * mm)}
    loads = [tg.Pressure("cavity", pressure)] if pressure else []
    model = tg.Model(mesh, sheets, [*free, *supports], loads)
    return mesh, problems.solve(model, tg.Static(first_step=1.0, max_step=1.0)).states[-1]


def _corners(tube, k):
    """Corners of the rhombus k at rest, by hand."""
    x, y = k * tube.row_length, (k % 2) * np.sqrt(tube.slant**2 - tube.row_length**2)
    L, H = tube.width / 2, tube.height / 2
    return [(x, y + L, 0.0), (x, y, H), (x, y - L, 0.0), (x, y, -H)]


@pytest.mark.parametrize(("sector", "fold"), [(50, 55), (60, 65), (70, 65)])
def test_a_pressed_tube_gets_narrower_and_taller_as_rigid_folding_does(sector, fold, record_verification):
    tube = tg.actuators.MiuraTube(rows=2, sector_angle=sector * deg, fold_angle=fold * deg)
    press = tg.Displacement("tip", (-0.02 * tube.length, 0, 0), "x")
    mesh, state = _solved(tube, 0.3 * mm, [press])
    near = [np.linalg.norm(mesh.points - corner, axis=1).argmin() for corner in _corners(tube, 1)]
    moved = state.displacement[near]
    got = ((moved[0, 1] - moved[2, 1]) / tube.width, (moved[1, 2] - moved[3, 2]) / tube.height)
    shorter = 0.98 * tube.row_length
    width = 2 * tube.side * tube.slant * np.cos(sector * deg) / np.sqrt(tube.slant**2 - shorter**2)
    expected = (width / tube.width - 1, np.sqrt(4 * tube.side**2 - width**2) / tube.height - 1)
    record_verification(
        claim=f"Miura tube, γ = {sector}°, θ = {fold}°, pressed by 2 %: strain of width and height",
        source="Schenk and Guest 2013, rigid folding", expected=expected, got=got, tolerance="8 %",
    )  # fmt: skip
    assert got == pytest.approx(expected, rel=0.08)


def test_vacuum_shortens_a_steep_tube_and_lengthens_a_flat_one(record_verification):
    ways = []
    for fold in (30, 60):
        tube = tg.actuators.MiuraTube(rows=2, fold_angle=fold * deg)
        mesh, state = _solved(tube, 1 * mm, [tg.supports.PlaneSection("tip")], -1 * kPa)
        assert (tube.height / tube.width > tube.row_length / tube.slant) == (fold == 60)
        ways.append(state.displacement[mesh.face_nodes("tip"), 0].mean() / mm)
    record_verification(
        claim="Miura tube at -1 kPa, fold angles of 30 and 60° at rest: way of the end [mm]",
        source="volume of rigid folding", expected="longer, then shorter", got=tuple(ways), tolerance="sign",
    )  # fmt: skip
    assert ways[0] > 0.02
    assert ways[1] < -0.02


@lru_cache
def _shortened(rows, fold):
    """Way [mm] of a rigid end plate at -10 kPa, the film 1 mm thick."""
    mesh = tg.mesh(tg.actuators.MiuraTube(rows=rows, fold_angle=fold * deg), size=8 * mm)
    supports = ["fixed", tg.supports.ReferencePoint("end", "tip")]
    sheets = {"film": tg.Shell(FILM, 1 * mm), "tip": tg.Shell(FILM, 5 * mm)}
    model = tg.Model(mesh, sheets, supports, [tg.Pressure("cavity", -10 * kPa)])
    last = problems.solve(model, tg.Static(first_step=0.5, max_step=0.5)).states[-1]
    return -last.displacement[mesh.face_nodes("tip"), 0].mean() / mm


@pytest.mark.parametrize(
    ("what", "tubes"),
    [
        ("two and four rows", [(2, 65), (4, 65)]),
        ("fold angles of 55, 65 and 75°", [(4, 55), (4, 65), (4, 75)]),
    ],
)
def test_more_rows_and_steeper_folds_shorten_further(what, tubes, record_verification):
    ways = [_shortened(*each) for each in tubes]
    record_verification(
        claim=f"Miura tube at -10 kPa, {what}: contraction [mm]",
        source="guideline", expected="rises by a fifth at least", got=tuple(ways), tolerance="sign",
    )  # fmt: skip
    assert (np.diff(ways) > 0.2 * np.array(ways[:-1])).all()
