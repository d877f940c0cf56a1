"""The mold of any part: it fills its block around the casting, opens, and says what it cannot do."""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.geometry import occ
from turgor.core.geometry.molds.casting_mold import casting_mold
from turgor.core.geometry.molds.mold import MoldSettings, mold_part
from turgor.core.geometry.molds.parting import partings
from turgor.core.geometry.shapes.solids import union
from turgor.core.meshing.exchange.formats.write_stl import write_stl
from turgor.units import deg, mm

FINGER = tg.cad.CadFile(
    file="examples/cad_file.step",
    faces={"fixed": tg.cad.WithNormal("-x"), "tip": tg.cad.WithNormal("+x")},
)
BOX = occ.Box(occ.Pnt(-10, -10, -10), occ.Pnt(10, 10, 10))
PARTS = {
    "a tube along the plane": tg.actuators.ExtendingCylinder(inlet_diameter=4 * mm),
    "a flat bottom, an opening above it": tg.actuators.RectangularBender(inlet_diameter=3 * mm),
    "folds": tg.actuators.BellowsOfRevolution(inlet_diameter=3 * mm, folds=2),
    "two chambers": tg.actuators.BidirectionalBender(inlet_diameter=3 * mm),
    "a STEP file": FINGER,
}


@pytest.fixture(scope="module", params=list(PARTS))
def mold(request):
    return PARTS[request.param], casting_mold(PARTS[request.param])


def overlap(a, b):
    return sum(solid.mass for solid in (a * b).solids)


def whole(actuator):
    kind = {"symmetry": "none"} if isinstance(actuator, tg.cad.CadFile) else {"symmetric": False}
    return union(list(replace(actuator, **kind).build().shape.solids))


def test_parts_and_casting_share_no_space_and_fill_the_block(mold):
    actuator, made = mold
    body = whole(actuator)
    shapes = {name: part.shape for name, part in made.parts.items()}
    for name, shape in shapes.items():
        assert len(list(shape.solids)) == 1, name
        assert overlap(shape, body) == pytest.approx(0, abs=1e-3), name
        assert all(overlap(shape, other) < 1e-3 for key, other in shapes.items() if key != name), name
    corners = np.array([[[c[i] for i in range(3)] for c in shapes[half].bounding_box] for half in ("lower", "upper")])
    block = np.prod(corners[:, 1].max(axis=0) - corners[:, 0].min(axis=0))
    cores = sum(shape.mass for name, shape in shapes.items() if name.startswith("core"))
    left = block - body.mass - shapes["lower"].mass - shapes["upper"].mass - cores
    # what is left are the holes to pour and the clearance of the pins, less what cores stand out
    assert -400 * (len(shapes) - 2) < left < 400


def test_halves_come_off_after_the_cores(mold):
    """Pulled by three millimeters, no half has entered the casting."""
    actuator, made = mold
    body, axis = whole(actuator), "xyz".index(made.notes[0][-2])
    for name, way in (("lower", -3.0), ("upper", 3.0)):
        step = [0.0, 0.0, 0.0]
        step[axis] = way
        moved = made.parts[name].shape.Move(tuple(step))
        assert overlap(moved, body) == pytest.approx(0, abs=1e-2), name
        cores = [part.shape for key, part in made.parts.items() if key.startswith("core")]
        assert all(overlap(moved, core) < 1e-2 for core in cores), name


def test_parts_are_closed_stl(tmp_path):
    for name, part in casting_mold(PARTS["a flat bottom, an opening above it"]).parts.items():
        made = write_stl(part, tmp_path / f"{name}.stl")
        assert made.volume == pytest.approx(part.solid_volume, rel=2e-2)


def test_a_core_that_is_as_wide_as_its_opening_is_pulled_out():
    wide = casting_mold(mold_part("cup", "body", BOX - occ.Box(occ.Pnt(-8, -8, -8), occ.Pnt(10, 8, 8))))
    assert any("pulled out along +x" in note for note in wide.notes)
    narrow = casting_mold(PARTS["a tube along the plane"])
    assert any("wider than its opening at -x" in note for note in narrow.notes)


def test_the_parting_plane_is_the_equator_of_a_ball_and_the_back_of_a_cone():
    turn, rise = np.meshgrid(np.linspace(0, 2 * np.pi, 41), np.linspace(0, np.pi, 21))
    ball = np.stack([np.sin(rise) * np.cos(turn), np.sin(rise) * np.sin(turn), np.cos(rise) + 3], axis=-1)
    parting = partings(_triangles(ball))[0]
    assert (parting.axis, parting.undercut) == (2, 0.0)
    assert parting.height == pytest.approx(3.0, abs=1e-6)
    hourglass = np.stack([(1 + abs(np.cos(rise))) * np.cos(turn), (1 + abs(np.cos(rise))) * np.sin(turn), -rise], -1)
    assert partings(_triangles(hourglass))[0].axis != 2, "its waist holds halves back that are pulled along z"


def _triangles(grid):
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    return np.concatenate([np.stack([a, b, c], axis=-2), np.stack([a, c, d], axis=-2)]).reshape(-1, 3, 3)


def test_what_has_no_mold_is_refused_with_its_reason():
    with refused("'cavity'", "closed", "inlet_diameter"):
        casting_mold(tg.actuators.ExtendingCylinder())
    with refused("whole part"):
        casting_mold(tg.actuators.ExtendingCylinder(inlet_diameter=4 * mm).build())
    with refused("STEP"):
        casting_mold(tg.actuators.Pouch())
    crossed = _crossed()
    with refused("halves", "pulled along", "1 mm²"):
        casting_mold(crossed)
    peeled = casting_mold(crossed, MoldSettings(undercut=1.0))
    assert any("peel" in note for note in peeled.notes)


def _crossed():
    """A block with a groove in three of its sides: every pull has an undercut."""
    block = BOX
    for u, v in ((0, 1), (1, 2), (2, 0)):
        low, high = [-2.0] * 3, [2.0] * 3
        low[u], high[u] = 6.0, 11.0
        low[v], high[v] = -11.0, 11.0
        block = block - occ.Box(occ.Pnt(*low), occ.Pnt(*high))
    return mold_part("crossed", "body", block)


def test_pins_of_the_lower_half_stand_in_holes_of_the_upper_one():
    parts = casting_mold(PARTS["a tube along the plane"]).parts
    above = occ.Box(occ.Pnt(-50, -50, 0), occ.Pnt(150, 50, 50))
    assert overlap(parts["lower"].shape, above) == pytest.approx(4 * np.pi * 1.5**2 * 3, rel=1e-6)
    mirrored = sum(solid.mass for solid in (parts["upper"].shape * above).solids)
    below = parts["lower"].shape.mass - overlap(parts["lower"].shape, above)
    holes = 4 * np.pi * 1.7**2 * 3.2
    pours = below - holes - mirrored
    assert 2 * np.pi * 4 * 8 < pours < 2 * np.pi * 4 * 8.4, "the two holes to pour go through the wall above the tube"


def test_settings_change_the_block():
    thin = casting_mold(PARTS["a tube along the plane"], MoldSettings(wall=5 * mm))
    thick = casting_mold(PARTS["a tube along the plane"])
    assert thin.parts["lower"].solid_volume < thick.parts["lower"].solid_volume


def test_faces_without_draft_are_listed_with_what_they_lack():
    """A frustum with one upright side: its draft is that of the drawing, and the upright side has none."""
    for angle, drafted in ((2, 0), (0.5, 3)):
        up = np.tan(angle * deg) * 10
        bottom, top = (
            [(-10, -5), (10, -5), (10, 5), (-10, 5)],
            [(-10, -5 + up), (10 - up, -5 + up), (10 - up, 5 - up), (-10, 5 - up)],
        )
        wires = [_outline(corners, z) for corners, z in ((bottom, 0.0), (top, 10.0))]
        frustum = mold_part("frustum", "body", occ.ThruSections(wires, True))
        lines = "\n".join(casting_mold(frustum).notes)
        upright = 10 * (10 + 10 - 2 * up) / 2
        assert f"{upright:.4g} mm² around (-10, 0, " in lines
        assert lines.count("mm² around") == 1 + drafted
        assert lines.count(": 0.5°, 0.5° less") == drafted


def test_a_core_without_draft_is_listed():
    cup = mold_part("cup", "body", BOX - occ.Box(occ.Pnt(-8, -8, -8), occ.Pnt(10, 8, 8)))
    lines = casting_mold(cup).notes
    start = next(i for i, line in enumerate(lines) if "pull of the core" in line)
    assert sum("mm² around" in line for line in lines[start:]) == 4
    assert any("288 mm² around (1, " in line for line in lines[start:])


def _outline(corners, z):
    points = [occ.Pnt(x, y, z) for x, y in corners]
    return occ.Wire([occ.Segment(a, b) for a, b in zip(points, [*points[1:], points[0]], strict=True)])
