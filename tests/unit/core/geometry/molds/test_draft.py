"""Draft: walls recede by its tangent from the parting plane, so sections and volumes have closed forms; molds open."""

from itertools import pairwise
from math import pi, tan

import numpy as np
import pytest
from scipy.integrate import quad

import turgor as tg
from refused import refused
from turgor.core.geometry import occ
from turgor.core.geometry.cad.facets import round_facets
from turgor.core.geometry.molds.casting_mold import casting_mold
from turgor.core.geometry.molds.draft import draftless, slopes
from turgor.core.geometry.molds.mold import MoldSettings, mold_part
from turgor.core.geometry.molds.taper.pull import Pull
from turgor.core.geometry.molds.taper.tapered import tapered
from turgor.units import deg, mm

CUBE = occ.Box(occ.Pnt(-10, -10, -10), occ.Pnt(10, 10, 10))
CUP = CUBE - occ.Box(occ.Pnt(-8, -8, -8), occ.Pnt(10, 8, 8))


def block(*bounds):
    return occ.Box(occ.Pnt(*bounds[:3]), occ.Pnt(*bounds[3:]))


def post(x, y, z, radius, height):
    return occ.Cylinder(occ.Pnt(x, y, z), occ.Z, r=radius, h=height)


def rounded(shape, radius, *corners):
    """Round the upright edges at some corners."""
    upright = [e for e in shape.edges if abs(e.start[2] - e.end[2]) > 1]
    chosen = [e for e in upright if any(np.hypot(e.start[0] - x, e.start[1] - y) < 1e-6 for x, y in corners)]
    return shape.MakeFillet(chosen, radius)


ELL = (block(0, 0, 0, 20, 10, 10) + block(0, 0, 0, 8, 25, 10)).UnifySameDomain()
PLATE = block(0, 0, 0, 20, 20, 5)
#: Shapes with walls along z, the heights at which their sections change, and sections by height and recess.
SHAPES = {
    "inner corner under a step": (
        block(0, 0, 0, 20, 10, 10) + block(0, 0, 0, 8, 25, 6),
        (6, 10),
        lambda z, t: (20 - 2 * t) * (10 - 2 * t) + (8 - 2 * t) * 15 * (z < 6),
    ),
    "two blocks and a channel": (
        block(0, 0, 0, 10, 10, 10) + block(10, 4, 0, 20, 6, 3) + block(20, 0, 0, 30, 10, 10),
        (3, 10),
        lambda z, t: 2 * (10 - 2 * t) ** 2 + (2 - 2 * t) * (10 + 2 * t) * (z < 3),
    ),
    "two blocks on a floor, with a channel": (
        block(0, 0, 0, 24, 10, 2) + block(0, 0, 2, 10, 10, 9) + block(14, 0, 2, 24, 10, 9) + block(10, 4, 2, 14, 6, 4),
        (2, 4, 9),
        lambda z, t: (
            (24 - 2 * t) * (10 - 2 * t) if z < 2 else 2 * (10 - 2 * t) ** 2 + (2 - 2 * t) * (4 + 2 * t) * (z < 4)
        ),
    ),
    "post on a plate": (
        block(0, 0, 0, 30, 30, 4) + post(15, 15, 4, 4, 8),
        (4, 12),
        lambda z, t: (30 - 2 * t) ** 2 if z < 4 else pi * (4 - t) ** 2,
    ),
    "hole": (
        block(0, 0, 0, 30, 30, 4) - post(15, 15, 0, 4, 4),
        (4,),
        lambda z, t: (30 - 2 * t) ** 2 - pi * (4 + t) ** 2,
    ),
    "round corners": (
        rounded(PLATE, 3, (0, 0), (20, 0), (0, 20), (20, 20)),
        (5,),
        lambda z, t: (20 - 2 * t) ** 2 - (4 - pi) * (3 - t) ** 2,
    ),
    "round inner corner": (
        rounded(ELL, 2, (8, 10)),
        (10,),
        lambda z, t: (20 - 2 * t) * (10 - 2 * t) + (8 - 2 * t) * 15 + (1 - pi / 4) * (2 + t) ** 2,
    ),
}


@pytest.mark.parametrize("draft", [0.5 * deg, 5 * deg])
@pytest.mark.parametrize("name", SHAPES)
def test_sections_recede_by_the_tangent_of_the_draft(name, draft):
    shape, heights, section = SHAPES[name]
    made = tapered(shape, Pull(axis=2, side=1, height=0.0, draft=draft))
    ends = (0, *heights)
    exact = sum(quad(lambda z: section(z, z * tan(draft)), a, b, epsabs=1e-12)[0] for a, b in pairwise(ends))
    assert len(list(made.solids)) == 1
    assert sum(solid.mass for solid in made.solids) == pytest.approx(exact, rel=1e-9)
    surface = round_facets(made)
    assert slopes(surface, 2).min() > draft * (1 - 1e-5)
    assert draftless(surface, 2, draft, "halves") == []


def test_a_wall_with_less_draft_gets_what_it_lacks_and_one_with_more_stays():
    start = Pull(axis=2, side=1, height=0.0, draft=2 * deg)
    frustum = tapered(block(0, 0, 0, 20, 10, 10), start)
    more = tapered(frustum, Pull(axis=2, side=1, height=0.0, draft=3 * deg))
    exact = tapered(block(0, 0, 0, 20, 10, 10), Pull(axis=2, side=1, height=0.0, draft=3 * deg))
    assert more.mass == pytest.approx(exact.mass, rel=1e-9)
    less = tapered(frustum, Pull(axis=2, side=1, height=0.0, draft=1 * deg))
    assert less.mass == pytest.approx(frustum.mass, rel=1e-12)


def test_walls_of_a_cup_stay_as_thick_and_its_mold_opens():
    """Outside and core are tapered from the plane of the opening, x = 10 mm."""
    draft = 3 * deg
    mold = casting_mold(mold_part("cup", "body", CUP), MoldSettings(draft=draft))
    t = tan(draft)
    outside, core = quad(lambda z: (20 - 2 * t * z) ** 2, 0, 20)[0], quad(lambda z: (16 - 2 * t * z) ** 2, 0, 18)[0]
    assert mold.casting.solid_volume * 1e9 == pytest.approx(outside - core, rel=1e-9)
    assert mold.casting.cavity_volume * 1e9 == pytest.approx(core, rel=1e-6)
    assert mold.casting.smallest_wall == pytest.approx(2 * mm * np.cos(draft), rel=5e-3)
    text = "\n".join(mold.notes)
    assert "Faces with a draft" not in text
    assert f"{outside - core:.5g} mm³ instead of 3392 mm³" in text
    assert "compute the casting" in text
    body = mold.casting.shape
    shapes = {name: part.shape for name, part in mold.parts.items()}
    for name, way in (("lower", -0.01), ("upper", 0.01), ("core", 0.01)):
        others = [body] if name == "core" else [body, shapes["core"]] if name == "lower" else [body]
        moved = shapes[name].Move((way, 0, 0))
        assert all(sum(solid.mass for solid in (moved * each).solids) < 1e-6 for each in others), name
    # with draft a wall lets go at once: after the first 0.01 mm there is air between
    lower = shapes["lower"].Move((-0.01, 0, 0))
    inner = [v for v in body.vertices if v.p[0] < 9]
    away = min(lower.Distance(v) for v in inner if max(abs(v.p[1]), abs(v.p[2])) > 8.5)
    assert away == pytest.approx(0.01 * np.sin(draft), rel=1e-3)


def test_chambers_of_a_pneunet_narrow_and_keep_their_walls():
    finger = tg.FastPneuNet(chambers=2, length=20 * mm)
    draft = 4 * deg
    mold = casting_mold(finger, MoldSettings(draft=draft))
    t = tan(draft)
    whole, across, tall = 6.5, 16.0, 10.0  # inside of a chamber
    chamber = quad(lambda z: (whole - 2 * t * z) * (across - 2 * t * z), 0, tall)[0]
    between = quad(lambda z: (3 - 2 * t * z) * (3 + 2 * t * z), 0, 2)[0]
    assert mold.casting.cavity_volume * 1e9 == pytest.approx(2 * chamber + between, rel=1e-6)
    assert mold.casting.smallest_wall == pytest.approx(1 * mm * np.cos(draft), rel=5e-3)
    assert set(mold.casting.faces) == {"cavity", "fixed", "outside", "strain_limiting_layer", "tip"}
    assert mold.casting.regions == ("body", "base")
    for name in ("cup", "core", "tray"):
        surface = round_facets(mold.parts[name].shape)
        low, high = mold.parts[name].shape.bounding_box
        middle = surface.corners.mean(axis=1)[:, :2]
        inner = (middle > np.array([low[i] + 7 for i in (0, 1)])) & (middle < np.array([high[i] - 7 for i in (0, 1)]))
        assert slopes(surface, 2)[inner.all(axis=1)].min() > draft * (1 - 1e-5), name


def test_a_wall_that_the_draft_thins_is_a_finding():
    bender = tg.actuators.RectangularBender(length=30 * mm, inlet_diameter=3 * mm)
    mold = casting_mold(bender, MoldSettings(draft=2 * deg, smallest_wall=1.8 * mm))
    (finding,) = mold.findings
    assert finding.code == "D09"
    thin = 2 - 10.5 * tan(2 * deg)  # at the top of the chamber
    assert thin < mold.casting.smallest_wall / mm < thin + 0.05
    assert "smallest_wall is 1.8 mm" in finding.message
    assert any("stays upright" in note for note in mold.notes), "the step with the core slides along its wall"
    assert sum("mm² around (0, 0," in note for note in mold.notes) == 1
    with refused("draft", "9 deg", "0 deg to 3.7 deg", "end", "core"):  # 1.2 mm at 18 mm: 3.81°
        cup = CUBE - occ.Box(occ.Pnt(-8, -1.2, -8), occ.Pnt(10, 1.2, 8))
        casting_mold(mold_part("cup", "body", cup), MoldSettings(draft=9 * deg))


def test_a_draft_that_does_not_fit_is_refused_with_its_range():
    for draft in (-1 * deg, 10.5 * deg):
        with refused("draft", f"{draft / deg:g} deg", "0 deg to 10 deg"):
            MoldSettings(draft=draft)
    with refused("smallest_wall", "0 mm"):
        MoldSettings(smallest_wall=0.0)
    thin = tg.actuators.RectangularBender(length=20 * mm, inlet_diameter=3 * mm, side_wall=1 * mm)
    with refused("draft", "9 deg", "0 deg to 5.4 deg", "wall of a cavity"):
        casting_mold(thin, MoldSettings(draft=9 * deg))  # 1 mm at 10.5 mm: 5.44°
    oval = mold_part("oval", "body", occ.WorkPlane().Ellipse(10, 6).Face().Extrude(8))
    with refused("draft", "2 deg", "no wall"):
        casting_mold(oval, MoldSettings(draft=2 * deg))


def test_the_part_is_as_before_and_its_names_stay():
    part = mold_part("cup", "body", CUP)
    for face in part.shape.faces:
        face.name = "cavity" if face.center[0] > -9 else "fixed"
    names = [face.name for face in part.shape.faces]
    casting_mold(part)
    assert [face.name for face in part.shape.faces] == names
