"""Measures of the shape: bodies laid out as arcs and helices by formula have the numbers that they were given.

Twelve cells along the body: half a percent.
"""

import re
from pathlib import Path

import numpy as np
import pytest
import results_cases as cases

import turgor as tg
from refused import refused
from turgor.core.geometry.directions import rotation_of, rotation_vector
from turgor.core.results.measures.measures import MEASURES, find_measure, measure
from turgor.core.results.measures.shape.arcs import distance_from_arc
from turgor.core.results.measures.shape.screws import screw_between, screw_path
from turgor.units import deg, mm

STRETCH = 1.1
MIDDLE = np.array([0.0, 0.0, cases.HEIGHT / 2])


@pytest.fixture(autouse=True)
def finer(monkeypatch):
    monkeypatch.setattr(cases, "COUNTS", (12, 4, 3))


def helix(turn):
    """Lay every section along a screw motion: ``turn`` is (twist, about y, about z) for each length at rest [1/m]."""

    def place(points):
        R, way = screw_path(np.array(turn), np.array([STRETCH, 0, 0]), points[:, 0])
        return np.einsum("kij,kj->ki", R, points * [0, 1, 1] - MIDDLE) + way + MIDDLE

    return place


def read(name, place, half=False):
    return find_measure(name)(cases.state(cases.model(cases.body(half=half)), place))


@pytest.mark.parametrize("turn", [(5.0, 10.0, -4.0), (-8.0, 20.0, 5.0), (0.0, 25.0, 0.0)])
def test_helix_and_arc_are_found_again(turn):
    square, bend = sum(t * t for t in turn), np.hypot(turn[1], turn[2])
    close = {"rel": 5e-3, "abs": 1e-4}
    assert read("curvature", helix(turn)) == pytest.approx(bend / STRETCH, rel=5e-3)
    assert read("bending_radius", helix(turn)) == pytest.approx(STRETCH / bend, rel=5e-3)
    assert read("helix_radius", helix(turn)) == pytest.approx(bend * STRETCH / square, **close)
    assert read("helix_pitch", helix(turn)) == pytest.approx(2 * np.pi * turn[0] * STRETCH / square, rel=8e-3, abs=2e-4)


@pytest.mark.parametrize("plane", [-170, -90, 0, 35, 90])
def test_bending_plane_is_counted_from_the_base(plane):
    about_y, about_z = 15 * np.cos(plane * deg), 15 * np.sin(plane * deg)
    assert read("bending_plane", helix((0.0, about_y, about_z))) / deg == pytest.approx(plane, abs=0.2)


def test_bending_towards_the_base_is_the_plane_zero_and_a_half_has_the_same_shape():
    for half in (False, True):
        assert read("bending_plane", cases.bent(90 * deg), half) / deg == pytest.approx(0, abs=0.01)
        assert read("curvature", cases.bent(90 * deg), half) == pytest.approx(90 * deg / cases.LENGTH, rel=2e-3)


def test_what_is_straight_has_no_radius_and_no_plane():
    for name in ("bending_radius", "bending_plane", "helix_radius", "helix_pitch"):
        assert np.isnan(read(name, cases.stretched(1.2)))
    assert read("curvature", cases.stretched(1.2)) == pytest.approx(0, abs=1e-9)
    assert read("arc_deviation", cases.stretched(1.2)) == pytest.approx(0, abs=1e-9)


def test_profile_follows_a_curvature_that_grows_along_the_length():
    """A clothoid: curvature 600/m² times x. Sections stay plane and perpendicular to the middle line."""
    rate = 600.0

    def clothoid(points):
        x, y, z = points.T
        s = np.linspace(0, 1, 400)
        t = np.trapezoid
        angle = 0.5 * rate * np.outer(x, s) ** 2
        along, up = x * t(np.cos(angle), s, axis=1), -x * t(np.sin(angle), s, axis=1)
        turn = 0.5 * rate * x**2
        return np.stack([along + (z - MIDDLE[2]) * np.sin(turn), y, MIDDLE[2] + up + (z - MIDDLE[2]) * np.cos(turn)], 1)

    line = tg.measures.center_line(cases.state(cases.model(cases.body()), clothoid))
    middles = (line.rest[1:, 0] + line.rest[:-1, 0]) / 2
    assert line.curvature == pytest.approx(rate * middles, rel=0.03, abs=0.1)
    table = line.response()
    assert table.names == ("arc_length", "curvature", "torsion", "stretch")
    assert table["stretch"] == pytest.approx(1, abs=5e-3)
    assert line.length == pytest.approx(np.ptp(line.rest[:, 0]), rel=2e-3)


def test_arc_deviation_of_an_arc_and_of_ripples_on_one():
    """Ripples of amplitude a on a circle are a/√2 from it in the mean, over the length of the line."""
    assert read("arc_deviation", cases.bent(150 * deg)) < 1e-4
    angle = np.linspace(0, 2.5, 400)
    rippled = (30 + 0.2 * np.sin(40 * angle)) * mm
    ripples = distance_from_arc(np.stack([rippled * np.cos(angle), 0 * angle, rippled * np.sin(angle)], axis=1))
    assert ripples == pytest.approx(0.2 * mm / np.sqrt(2), rel=0.02)


@pytest.mark.parametrize("half", [False, True])
@pytest.mark.parametrize("turn", [0.0, 1.5])
def test_ballooning_is_the_widest_growth_of_the_section_whatever_the_bending(half, turn):
    """Sections that grow by 1.3 across y and 1.1 across z, on an arc."""
    grown = [1.0, 1.3, 1.1]
    bend = cases.bent(turn)
    wide = read("ballooning", lambda X: bend((X - MIDDLE) * grown + MIDDLE), half)
    assert wide == pytest.approx(1.3, rel=5e-3)
    assert read("ballooning", helix((5.0, 10.0, 0.0) if turn else (0, 0, 0))) == pytest.approx(1, abs=0.01)


def test_screws_there_and_back():
    for turn in ([0.3, -0.2, 0.9], [1e-9, 0, 0], [0, 0, 0]):
        (R,), (way,) = screw_path(np.array(turn), np.array([1.0, 2.0, -0.5]), np.ones(1))
        assert pytest.approx(rotation_of(np.array(turn))) == R
        assert rotation_vector(R) == pytest.approx(turn, abs=1e-12)
        back, linear = screw_between(R, way)
        assert back == pytest.approx(turn, abs=1e-12)
        assert linear == pytest.approx([1.0, 2.0, -0.5])


def test_shape_in_a_response_and_too_coarse_a_mesh():
    model = cases.model(cases.body())
    path = [cases.state(model, cases.bent(a * deg), a / 90) for a in (0, 45, 90)]
    table = measure(cases.solution(path), "curvature", "bending_radius")
    assert table["curvature"] == pytest.approx(np.array([0, 45, 90]) * deg / cases.LENGTH, rel=3e-3, abs=1e-9)
    assert np.isnan(table["bending_radius"][0])
    with refused("curvatur", "curvature"):
        find_measure("curvatur")


def test_page_on_measures_names_every_measure_with_its_unit():
    """And every sketch that the script draws."""
    docs = Path(__file__).parents[5] / "docs"
    page = (docs / "measures.md").read_text(encoding="utf-8")
    by_axis = ("tip_displacement", "tip_stiffness", "blocked_force")
    written = {*re.findall(r"`(\w+)`", page), *(f"{name}_{axis}" for name in by_axis for axis in "xyz")}
    assert set(MEASURES) - written == set()
    shown = set(re.findall(r"images/measures/([\w-]+)\.svg", page))
    assert shown == {path.stem for path in (docs / "images" / "measures").glob("*.svg")}
