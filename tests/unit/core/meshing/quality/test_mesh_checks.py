"""Findings about a mesh: one cell through a wall, an open cavity, unnamed or misplaced faces."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from netgen.occ import Box, Glue, Pnt, Z

from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.cad.read import read_cad
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.checks import check_mesh, crossings
from turgor.core.meshing.surface import check_surface, outer_triangles, rim_edges
from turgor.foundation.finding import Severity
from turgor.units import mm

pytestmark = pytest.mark.usefixtures("read_here")


@pytest.fixture(scope="module")
def half() -> Mesh:
    return mesh(FastPneuNet(chambers=2, length=20 * mm).build(), size=3 * mm)


@pytest.fixture(scope="module")
def whole() -> Mesh:
    return mesh(FastPneuNet(chambers=2, length=20 * mm, symmetric=False).build(), size=3 * mm)


def changed(mesh: Mesh, **faces: np.ndarray | None) -> Mesh:
    """The mesh with some faces replaced, or left out where None."""
    kept = {name: faces.get(name, triangles) for name, triangles in mesh.faces.items()}
    return replace(mesh, faces={name: triangles for name, triangles in kept.items() if triangles is not None})


def codes(mesh: Mesh) -> list[str]:
    return [finding.code for finding in check_surface(mesh)]


def slab(thickness: float, size: float, bottom: str = "outside") -> Mesh:
    """A plate of 10 x 10 mm in the plane and given thickness."""
    shape = Glue([Box(Pnt(0, 0, 0), Pnt(10, 10, thickness))])
    shape.mat("body")
    shape.faces.name = "outside"
    shape.faces.Min(Z).name = bottom
    wall = thickness * mm
    volume = 100 * thickness * mm**3
    names = {"regions": ("body",), "faces": tuple({"outside", bottom})}
    geometry = Geometry(name="slab", smallest_wall=wall, cavity_volumes={}, solid_volume=volume, shape=shape, **names)
    return mesh(geometry, size=size * mm)


def test_the_surface_of_a_whole_actuator_is_closed_and_that_of_its_half_too(half: Mesh, whole: Mesh) -> None:
    for body in (half, whole):
        assert len(rim_edges(outer_triangles(body))) == 0
        assert codes(body) == []
    assert len(rim_edges(whole.face("cavity"))) == 0
    rim = half.points[rim_edges(half.face("cavity"))]
    assert len(rim) > 0
    assert rim[..., 1] == pytest.approx(0, abs=1e-12)
    assert rim[:, 2] == pytest.approx((rim[:, 0] + rim[:, 1]) / 2)  # the mid-side node is the one between


def test_a_cavity_with_a_hole_is_found(whole: Mesh) -> None:
    holed = changed(whole, cavity=whole.face("cavity")[1:])
    findings = check_surface(holed)
    assert [f.code for f in findings] == ["G02", "G03"]
    assert findings[0].severity is Severity.ERROR
    assert "Face 'cavity' is not closed: 3 of its edges" in findings[0].message


def test_a_cavity_of_a_half_with_a_hole_is_found(half: Mesh) -> None:
    cavity = half.face("cavity")
    away = np.flatnonzero((half.points[cavity][:, :, 1] > 1e-9).all(axis=1))[0]
    assert codes(changed(half, cavity=np.delete(cavity, away, axis=0))) == ["G02", "G03"]


def test_a_cavity_cut_by_a_plane_without_the_name_of_a_mirror_is_open(half: Mesh) -> None:
    renamed = dict(half.faces)
    renamed["cut"] = renamed.pop("symmetry_y")
    (finding,) = check_surface(replace(half, faces=renamed))
    assert finding.code == "D01"
    assert finding.severity is Severity.WARNING
    assert "If this is a mirror plane, name it symmetry_*" in finding.advice


def test_surface_without_a_name_is_found(whole: Mesh) -> None:
    (finding,) = check_surface(changed(whole, outside=None))
    assert (finding.code, finding.severity) == ("G03", Severity.WARNING)
    assert finding.message.startswith(
        f"{len(whole.face('outside'))} of {len(outer_triangles(whole))} surface triangles"
    )


def test_faces_that_point_inward_or_hang_in_the_air_are_found(whole: Mesh) -> None:
    turned = whole.face("cavity")[:, [0, 2, 1, 5, 4, 3]]
    (finding,) = check_surface(changed(whole, cavity=turned))
    assert (finding.code, finding.severity) == ("G04", Severity.ERROR)
    assert f"{len(turned)} triangles facing inward" in finding.message
    stray = whole.face("tip").copy()
    stray[0, 0] = whole.face("fixed")[0, 0]
    assert "G04" in codes(changed(whole, tip=stray))


def test_a_layer_inside_the_body_may_point_either_way(whole: Mesh) -> None:
    assert codes(changed(whole, strain_limiting_layer=whole.face("strain_limiting_layer")[:, [0, 2, 1, 5, 4, 3]])) == []


def test_one_cell_through_a_plate_is_found_with_its_thickness() -> None:
    thin = slab(1.0, 3.0)
    edges, thickness = crossings(thin)
    assert len(edges) > 10
    assert thickness.min() == pytest.approx(1 * mm)
    assert np.ptp(thin.points[edges][..., 2], axis=1) == pytest.approx(1 * mm)
    (finding,) = check_mesh(thin)
    assert (finding.code, finding.severity) == ("G01", Severity.WARNING)
    assert f"in {len(edges)} places; the thinnest of these walls is 1 mm thick" in finding.message


def test_half_a_wall_at_a_mirror_plane_is_no_wall() -> None:
    assert len(crossings(slab(2.0, 3.0))[0]) > 10
    assert len(crossings(slab(2.0, 3.0, bottom="symmetry_z"))[0]) == 0


def test_a_thick_block_in_small_cells_has_no_wall_of_one_cell() -> None:
    assert check_mesh(slab(8.0, 2.5)) == ()


def test_the_thinnest_wall_of_an_actuator_is_named(half: Mesh) -> None:
    (finding,) = check_mesh(half)
    assert "the thinnest of these walls is 1 mm thick" in finding.message


def test_thinnest_wall_is_that_of_the_inspection() -> None:
    """Edges of cells cut corners where curved walls end: the shortest one made 0.62 mm of a wall of 1.5 mm."""
    part = read_cad(Path(__file__).parents[5] / "examples" / "print.stl")
    printed = mesh(part, size=3 * mm)
    (finding,) = [result for result in check_mesh(printed) if result.code == "G01"]
    told = float(re.search(r"these walls is ([\d.]+) mm thick", finding.message)[1])  # type: ignore[index]
    assert told * mm == pytest.approx(part.smallest_wall, rel=0.02)
