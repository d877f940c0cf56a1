"""A generated mesh fills the geometry, carries its names and keeps every promise of `Mesh`."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from meshing_cases import filleted_pneunet, thin_tube
from netgen.occ import Box, Cylinder, Glue, Pnt, X, Z

from refused import refused
from turgor.core.engine.faces.surfaces import area, enclosed_volume, vector_area
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing import generate
from turgor.core.meshing.bodies.assemble import Raw
from turgor.core.meshing.generate import default_size, mesh, size_range
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, TRIANGLE_EDGES, Mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.core.meshing.sizing.sizes import wall_size
from turgor.core.meshing.surface import cell_sides, check_surface, corner_keys, outer_triangles
from turgor.units import mm

FINGER = FastPneuNet(chambers=3, length=30 * mm)


def half_cylinder() -> Geometry:
    """Half a cylinder of 30 mm length and 10 mm radius, with a half-round hole of 6 mm radius."""
    shape = (
        Cylinder(Pnt(0, 0, 0), X, 10, 30) - Cylinder(Pnt(0, 0, 0), X, 6, 30) - Box(Pnt(-1, -20, -20), Pnt(40, 20, 0))
    )
    shape.faces.name = "outside"
    shape.faces.Min(X).name = "fixed"
    shape.mat("body")
    volume = np.pi * (100 - 36) / 2 * 30 * mm**3
    return Geometry(
        name="half cylinder",
        smallest_wall=4 * mm,
        cavity_volumes={},
        solid_volume=volume,
        regions=("body",),
        faces=("fixed", "outside"),
        shape=shape,
    )


@pytest.fixture(scope="module")
def finger() -> Mesh:
    return mesh(FINGER.build(), size=3 * mm)


@pytest.fixture(scope="module")
def curved() -> Mesh:
    return mesh(half_cylinder(), size=6 * mm)


def test_names_survive(finger: Mesh) -> None:
    assert sorted(finger.faces) == ["cavity", "fixed", "outside", "strain_limiting_layer", "symmetry_y", "tip"]
    assert sorted(finger.regions) == ["base", "body"]
    assert finger.name == "fast PneuNet, 3 chambers, half"


def test_volumes_and_areas_are_those_of_the_dimensions(finger: Mesh) -> None:
    # blocks of 28/3 mm; cavities 28 − 2·2 − 4·1 = 20 mm long together, 16 x 10 mm
    volumes = {name: cell_volumes(finger)[cells].sum() / mm**3 for name, cells in finger.regions.items()}
    assert volumes == pytest.approx({"base": 450, "body": FINGER.solid_volume / mm**3 - 450}, rel=1e-9)
    cavity = -enclosed_volume(finger.points, finger.face("cavity"))  # its normals point into the cavity
    assert cavity / mm**3 == pytest.approx((20 * 16 * 10 + 2 * 3 * 3 * 2) / 2, rel=1e-9)
    assert enclosed_volume(finger.points, outer_triangles(finger)) == pytest.approx(FINGER.solid_volume, rel=1e-9)
    results = {name: area(finger.points, triangles) / mm**2 for name, triangles in finger.faces.items()}
    assert results == pytest.approx(
        {
            "fixed": 150,
            "tip": 150,
            "strain_limiting_layer": 300,
            "symmetry_y": 30 * 3 + 28 * 12 + 2 * 3 - (20 * 10 + 6 * 2),
            "cavity": 2 * 20 * 8 + 20 * 10 + 6 * 80 - 4 * 3 + 6 * 5,
            "outside": 300 + 90 + 28 * 12 + 280 + 4 * (120 - 7.5) + 2 * (7.5 + 2.5 + 3),
        },
        rel=1e-9,
    )


def test_faces_point_out_of_the_solid(finger: Mesh) -> None:
    assert vector_area(finger.points, finger.face("fixed")) / mm**2 == pytest.approx([-150, 0, 0], abs=1e-6)
    assert vector_area(finger.points, finger.face("tip")) / mm**2 == pytest.approx([150, 0, 0], abs=1e-6)
    assert vector_area(finger.points, finger.face("symmetry_y"))[1] / mm**2 == pytest.approx(-220, abs=1e-6)
    layer = vector_area(finger.points, finger.face("strain_limiting_layer")) / mm**2
    assert layer == pytest.approx([0, 0, -300], abs=1e-6)  # out of the body, into the base


def test_the_layer_lies_between_the_regions_and_is_shared(finger: Mesh) -> None:
    layer = finger.face("strain_limiting_layer")
    assert finger.points[layer][..., 2] == pytest.approx(1.5 * mm, abs=1e-12)
    keys = corner_keys(layer, len(finger.points))
    assert len(np.unique(keys)) == len(keys)
    for cells in finger.regions.values():  # one cell of each region on every triangle
        sides = corner_keys(cell_sides(finger.cells[cells]), len(finger.points))
        assert np.isin(sides, keys).sum() == len(keys)


def test_no_node_is_double_or_unused(finger: Mesh) -> None:
    assert np.array_equal(np.unique(finger.cells), np.arange(len(finger.points)))
    assert len(np.unique(np.round(finger.points / (1e-6 * mm)), axis=0)) == len(finger.points)
    assert set(np.unique(finger.cells[:, :4])) == set(range(finger.vertex_count))


def test_cells_are_positive_and_mid_nodes_in_place(finger: Mesh) -> None:
    assert cell_volumes(finger).min() > 0
    for i, (a, b) in enumerate(TETRAHEDRON_EDGES):
        middle = finger.points[finger.cells[:, [a, b]]].mean(axis=1)
        assert finger.points[finger.cells[:, 4 + i]] == pytest.approx(middle, abs=1e-12)
    for triangles in finger.faces.values():
        for i, (a, b) in enumerate(TRIANGLE_EDGES):
            middle = finger.points[triangles[:, [a, b]]].mean(axis=1)
            assert finger.points[triangles[:, 3 + i]] == pytest.approx(middle, abs=1e-12)


def test_every_surface_triangle_has_exactly_one_name(finger: Mesh) -> None:
    named = np.concatenate([t for name, t in finger.faces.items() if name != "strain_limiting_layer"])
    keys, surface = (corner_keys(t, len(finger.points)) for t in (named, outer_triangles(finger)))
    assert np.array_equal(np.sort(keys), np.sort(surface))


def test_the_same_question_gives_the_same_mesh(finger: Mesh) -> None:
    again = mesh(FINGER.build(), size=3 * mm)
    assert np.array_equal(again.points, finger.points)
    assert np.array_equal(again.cells, finger.cells)
    assert all(np.array_equal(again.faces[name], finger.faces[name]) for name in finger.faces)


def test_a_smaller_size_gives_a_finer_mesh(finger: Mesh) -> None:
    finer = mesh(FINGER.build(), size=1.5 * mm)
    assert finer.unknown_count > 1.8 * finger.unknown_count


def test_mid_nodes_of_a_curved_face_lie_on_it(curved: Mesh) -> None:
    outside = curved.face("outside")
    corners, mids = (np.hypot(*np.moveaxis(curved.points[outside[:, s]], 2, 0)[1:]) for s in (slice(3), slice(3, 6)))
    round_face = (np.abs(corners - 10 * mm) < 1e-9).all(axis=1)
    assert round_face.sum() > 20
    assert mids[round_face] == pytest.approx(10 * mm, abs=1e-9)
    chords = [curved.points[outside[round_face][:, [a, b]]].mean(axis=1) for a, b in TRIANGLE_EDGES]
    sagitta = 10 * mm - np.hypot(*np.moveaxis(np.array(chords), 2, 0)[1:]).min()
    assert sagitta > 0.2 * mm  # the test can fail: straight edges would be this far off


def test_a_curved_mesh_has_the_volume_of_the_curved_part(curved: Mesh) -> None:
    volume = cell_volumes(curved).sum()
    assert volume == pytest.approx(half_cylinder().solid_volume, rel=1e-3)  # quadratic edges; straight ones: 2 %
    assert enclosed_volume(curved.points, outer_triangles(curved)) == pytest.approx(volume, rel=1e-9)
    assert area(curved.points, curved.face("fixed")) == pytest.approx(np.pi * 32 * mm**2, rel=1e-3)


@settings(max_examples=5, deadline=None)
@given(
    wall=st.floats(0.8, 2.5),
    gap=st.floats(0.4, 3.0),
    side_wall=st.floats(0.8, 4.0),
    channel_width=st.floats(1.0, 5.0),
    symmetric=st.booleans(),
)
def test_any_finger_is_filled_and_its_cavity_closed(
    wall: float, gap: float, side_wall: float, channel_width: float, symmetric: bool
) -> None:
    geometry = FastPneuNet(
        chambers=2,
        length=25 * mm,
        wall=wall * mm,
        gap=gap * mm,
        side_wall=side_wall * mm,
        channel_width=channel_width * mm,
        symmetric=symmetric,
    ).build()
    body = mesh(geometry, size=3 * mm)
    assert enclosed_volume(body.points, outer_triangles(body)) == pytest.approx(geometry.solid_volume, rel=1e-9)
    assert -enclosed_volume(body.points, body.face("cavity")) == pytest.approx(geometry.cavity_volume, rel=1e-9)
    assert check_surface(body) == ()


@pytest.mark.parametrize(
    ("size", "facts"),
    [
        (0, ("0 mm", "0.329 mm to 30 mm")),
        (-2 * mm, ("-2 mm", "0.329 mm to 30 mm")),
        (50 * mm, ("50 mm", "0.329 mm to 30 mm")),
        (3, ("3000 mm", "0.329 mm to 30 mm", "unit")),
        (0.05 * mm, ("0.05 mm", "850 million", "0.329 mm to 30 mm")),
        (float("nan"), ("nan", "in m")),
        ("3 kPa", ("3 kPa", "length")),
        (True, ("True", "in m")),
    ],
)
def test_a_size_that_makes_no_sense_is_refused(size: object, facts: tuple) -> None:
    with refused("size", *facts):
        mesh(FINGER.build(), size=size)


@pytest.mark.parametrize("grading", [0.0, 1.5, "fine"])
def test_a_grading_out_of_range_is_refused(grading: object) -> None:
    with refused("grading", f"{grading!r}", "0.1 to 1"):
        mesh(FINGER.build(), size=3 * mm, grading=grading)


def test_the_size_range_ends_at_the_part() -> None:
    low, high = size_range(half_cylinder())
    assert wall_size(half_cylinder()) == pytest.approx(16 * mm)
    assert high > 29 * mm  # the whole part
    assert 0 < low < 1 * mm


def box_with(faces: tuple[str, ...], regions: tuple[str, ...], volume: float) -> Geometry:
    shape = Glue([Box(Pnt(0, 0, 0), Pnt(10, 10, 10))])
    shape.mat("body")
    shape.faces.name = "outside"
    shape.faces.Max(Z).name = "tip"
    return Geometry(
        name="box",
        smallest_wall=10 * mm,
        cavity_volumes={},
        solid_volume=volume * mm**3,
        regions=regions,
        faces=faces,
        shape=shape,
    )


def test_a_name_or_volume_lost_in_meshing_is_refused() -> None:
    assert sorted(mesh(box_with(("outside", "tip"), ("body",), 1000), size=6 * mm).faces) == ["outside", "tip"]
    with refused("'box'", "face cavity"):
        mesh(box_with(("outside", "cavity"), ("body",), 1000), size=6 * mm)
    with refused("'box'", "region base"):
        mesh(box_with(("outside",), ("body", "base"), 1000), size=6 * mm)
    with refused("'box'", "1000 mm³", "1100 mm³"):
        mesh(box_with(("outside",), ("body",), 1100), size=6 * mm)


def test_a_part_that_cannot_be_meshed_is_refused_with_the_cause_and_nothing_else(
    capfd: pytest.CaptureFixture[str],
) -> None:
    shape = Cylinder(Pnt(0, 0, 0), X, 10, 30) - Cylinder(Pnt(0, 0, 0), X, 9.95, 30)
    shape.mat("body")
    shape.faces.name = "outside"
    names = {"regions": ("body",), "faces": ("outside",)}
    tube = Geometry(name="tube", smallest_wall=9 * mm, cavity_volumes={}, solid_volume=1e-6, shape=shape, **names)
    with refused("'tube'", "8 mm", "overlapping"):
        mesh(tube, size=8 * mm)  # cells so long that those inside and outside meet
    captured = capfd.readouterr()
    assert captured.out == ""
    assert captured.err == ""


@pytest.mark.parametrize("shape", [filleted_pneunet, thin_tube])
def test_a_curved_shape_gives_the_same_mesh_again(shape) -> None:
    geometry = shape()
    first, second, third = mesh(geometry), mesh(geometry), mesh(shape())
    for other in (second, third):
        assert np.array_equal(first.points, other.points)
        assert np.array_equal(first.cells, other.cells)
    assert default_size(shape()) == default_size(geometry)


def test_arcs_are_meshed_finer_where_the_first_mesh_is_not_sound() -> None:
    """A tube whose wall was said to be thicker than it is, so that the size goes far beyond four times the wall."""
    shape = Cylinder(Pnt(0, 0, 0), X, 10, 20) - Cylinder(Pnt(0, 0, 0), X, 9.5, 20)
    shape.mat("body")
    shape.faces.name = "outside"
    names = {"regions": ("body",), "faces": ("outside",), "cavity_volumes": {}}
    tube = Geometry(name="tube", smallest_wall=3 * mm, solid_volume=shape.mass * mm**3, shape=shape, **names)
    made = mesh(tube, size=8 * mm)
    assert cell_volumes(made).sum() == pytest.approx(tube.solid_volume, rel=1e-3)
    assert [finding.code for finding in made.findings] == ["G08"]
    assert "at first 'tube' could not be meshed at size 8 mm." in made.findings[0].message


def test_a_cell_inside_out_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    def bent(*settings: object) -> Raw:
        raw = original(*settings)
        raw.points[raw.cells[0, 0]] = raw.points[raw.cells[0, 1]]  # flat: straight edges do not help
        return raw

    original = generate.generated_cells
    monkeypatch.setattr(generate, "generated_cells", bent)
    monkeypatch.setattr(generate, "LOST_VOLUME", 1e9)
    with refused("of 28", "inside out"):
        mesh(box_with(("outside",), ("body",), 1000), size=6 * mm)


def test_the_generator_is_quiet(capfd: pytest.CaptureFixture[str]) -> None:
    mesh(box_with(("outside",), ("body",), 1000), size=6 * mm)
    captured = capfd.readouterr()
    assert captured.out == ""
    assert captured.err == ""
