"""Fillets, holes and engraved text below a limit make cells no smaller; larger rounds are followed as before."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from meshing_cases import named
from netgen.occ import Box, Cylinder, Pnt, Sphere, X, Z
from turgor.cad import WithNormal

import turgor as tg
from refused import refused
from turgor.core.geometry.cad.facets import round_facets
from turgor.core.geometry.cad.read import read_here
from turgor.core.meshing.generate import mesh_with
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.small_features import has_tiny_edges, small_features
from turgor.units import mm

CAD = Path(__file__).parents[3] / "data" / "cad"
ENDS = {"fixed": WithNormal("-x"), "tip": WithNormal("+x")}
QUARTER = {"symmetry_y": WithNormal("-y"), "symmetry_z": WithNormal("-z")}


@pytest.fixture(scope="module")
def lobed_bellows():
    """A quarter of a bellows of six lobes, whose edges have fillets of 0.8 mm."""
    return read_here(CAD / "bellows.step", faces=ENDS | QUARTER)


def plate_with(*, fillet: float, hole: float):
    """A plate 30 × 20 × 6 mm with one rounded edge and a hole."""
    plate = Box(Pnt(0, 0, 0), Pnt(30, 20, 6))
    edge = [e for e in plate.edges if abs(e.center.y) < 1e-6 and abs(e.center.z - 6) < 1e-6]
    return named(plate.MakeFillet(edge, fillet) - Cylinder(Pnt(15, 10, -1), Z, hole, 8), "plate", 6)


@pytest.mark.parametrize(
    ("shape", "radius"),
    [
        (Cylinder(Pnt(0, 0, 0), X, 3, 10), 3.0),
        (Sphere(Pnt(0, 0, 0), 5), 5.0),
        (Box(Pnt(0, 0, 0), Pnt(9, 9, 9)), np.inf),
    ],
)
def test_radii_of_facets_are_those_of_the_true_surface(shape, radius):
    shape.MakeTriangulation()
    assert round_facets(shape).radii.min() == pytest.approx(radius, rel=1e-4)


def test_a_bellows_with_small_fillets_gets_a_mesh_of_a_reasonable_size(lobed_bellows):
    part = lobed_bellows
    made = tg.mesh(part, size=2.5 * mm)
    assert made.unknown_count < 25_000
    assert cell_volumes(made).sum() == pytest.approx(part.solid_volume, rel=2e-3)
    (result,) = [finding for finding in made.findings if finding.code == "G11"]
    assert "below 1.25 mm: 24 of outside, 24 of cavity (smallest radius 0.8 mm)" in result.message
    assert 'a body of revolution: where its loads are the same all around, cells = "axisymmetric"' in result.advice


def test_the_limit_decides_which_rounds_are_left(lobed_bellows):
    part = lobed_bellows
    assert small_features(part, 2 * mm, 0.7 * mm) is None
    assert small_features(part, 2 * mm, 0.0) is None
    assert small_features(part, 1.5 * mm, None) is None, "fillets of half the size and more are followed"
    result = small_features(part, 2 * mm, 0.9 * mm)
    assert result.unknowns > 1e5
    assert not len(result.lines), "all other radii are larger than twice the size"


def test_only_parts_of_cad_files_are_coarse_by_themselves(lobed_bellows):
    assert small_features(replace(lobed_bellows, file=""), 2 * mm, None) is None


def test_six_cells_go_around_a_small_hole_and_one_over_a_small_fillet():
    part = plate_with(fillet=1.0, hole=1.5)
    result = small_features(part, 4 * mm, 2 * mm)
    assert set(np.round(result.line_sizes / mm, 3)) == {1.5}, "lines along the hole only"
    every, few = mesh_with(part, MeshSettings(size=4 * mm)), tg.mesh(part, size=4 * mm, ignore_features_below=2 * mm)
    assert few.unknown_count < 0.5 * every.unknown_count
    around = few.points[few.face_nodes("outside")]
    top = around[np.isclose(around[:, 2], 6 * mm) & (np.hypot(around[:, 0] - 15e-3, around[:, 1] - 10e-3) < 1.51e-3)]
    assert 12 <= len(top) <= 18, "corners and mid-side nodes of six to nine cells"
    assert cell_volumes(few).sum() == pytest.approx(part.solid_volume, rel=2e-3)


def test_larger_rounds_keep_their_cells():
    part = plate_with(fillet=0.5, hole=4.0)
    result = small_features(part, 4 * mm, 1 * mm)
    assert set(np.round(result.line_sizes / mm, 2)) == {2.0}, "half the radius of the hole, as without a limit"


def test_engraved_text_is_left_out_where_a_limit_is_stated():
    part = read_here(CAD / "labeled_box.step", faces=ENDS)
    assert has_tiny_edges(part, 1 * mm)
    assert not has_tiny_edges(plate_with(fillet=1.0, hole=1.5), 1 * mm)
    made = tg.mesh(part, size=4 * mm, ignore_features_below=1 * mm)
    assert made.unknown_count < 12_000  # 36,000 with all edges
    assert cell_volumes(made).sum() == pytest.approx(part.solid_volume, rel=2e-3)
    assert "edges shorter than 0.5 mm" in next(f.message for f in made.findings if f.code == "G11")


@pytest.mark.parametrize(
    ("settings", "facts"),
    [
        ({"ignore_features_below": -1e-3}, ("-1 mm", "0 to 2 mm")),
        ({"ignore_features_below": 3e-3}, ("3 mm", "0 to 2 mm")),
        ({"ignore_features_below": "1 mm"}, ("'1 mm'", "meters")),
        ({"ignore_features_below": 1e-3, "cells": "hexahedra"}, ("hexahedra",)),
    ],
)
def test_limits_without_a_meaning_are_refused(settings, facts):
    with refused("ignore_features_below", *facts):
        tg.mesh(tg.FastPneuNet(chambers=2, length=20 * mm).build(), size=2 * mm, **settings)
