"""The default size suits the walls; sizes of faces refine them; what cannot be is one sentence."""

from dataclasses import replace

import numpy as np
import pytest

from refused import refused
from turgor.core.geometry.actuators.eccentric_bender import EccentricBender
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.actuators.helical_pneunet import HelicalPneuNet
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.mesh import TRIANGLE_EDGES, Mesh
from turgor.core.meshing.sizing.default_size import default_size
from turgor.core.meshing.sizing.settings import SIZING
from turgor.core.meshing.sizing.sizes import wall_size
from turgor.units import mm

SMALL = FastPneuNet(chambers=2, length=20 * mm)


def longest_edge(made: Mesh, face: str) -> float:
    corners = made.points[made.face(face)[:, :3]]
    return max(float(np.linalg.norm(corners[:, a] - corners[:, b], axis=1).max()) for a, b in TRIANGLE_EDGES)


def test_the_default_is_twice_the_thinnest_wall() -> None:
    geometry = FastPneuNet().build()
    assert default_size(geometry) == 2 * mm
    assert default_size(replace(geometry, smallest_wall=1.26 * mm)) == 2.5 * mm  # two digits


def test_the_default_is_coarser_where_it_would_make_too_many_unknowns_and_finer_in_a_small_part() -> None:
    geometry = FastPneuNet().build()
    thin = replace(geometry, smallest_wall=0.5 * mm)
    unknowns = SIZING.unknowns_per_volume * geometry.solid_volume / default_size(thin) ** 3
    assert unknowns == pytest.approx(SIZING.default_unknowns, rel=0.2)
    assert default_size(thin) > 1 * mm
    thinner = replace(geometry, smallest_wall=0.2 * mm)
    assert default_size(thinner) == pytest.approx(wall_size(thinner))  # four times the wall, whatever it costs
    assert default_size(replace(geometry, smallest_wall=40 * mm)) == 13 * mm  # an eighth of 110 mm


def test_where_four_times_the_wall_cannot_be_solved_only_thin_walls_get_such_cells() -> None:
    geometry = FastPneuNet().build()
    thinnest = replace(geometry, smallest_wall=0.05 * mm)
    assert SIZING.unknowns_per_volume * geometry.solid_volume / wall_size(thinnest) ** 3 > SIZING.most_unknowns
    unknowns = SIZING.unknowns_per_volume * geometry.solid_volume / default_size(thinnest) ** 3
    assert unknowns == pytest.approx(SIZING.default_unknowns, rel=0.2)


def test_no_size_means_the_default_size() -> None:
    geometry = SMALL.build()
    made, same = mesh(geometry, cells="tetrahedra"), mesh(geometry, size=2 * mm)
    assert np.array_equal(made.points, same.points)
    assert np.array_equal(made.cells, same.cells)


def test_no_size_and_no_cells_mean_hexahedra_where_a_section_is_swept() -> None:
    geometry = SMALL.build()
    made, same = mesh(geometry), mesh(geometry, size=default_size(geometry, "hexahedra"), cells="hexahedra")
    assert np.array_equal(made.points, same.points)
    assert mesh(replace(geometry, _sweep=None)).cell_type.name == "ten-node tetrahedron"
    assert mesh(geometry, face_sizes={"tip": 1 * mm}).cell_type.name == "ten-node tetrahedron"


def test_tetrahedra_fill_a_section_whose_hexahedra_would_turn_over() -> None:
    geometry = replace(EccentricBender(), outer_radius=1.5 * EccentricBender().outer_radius).build()
    with refused("of 245", "inside out"):
        mesh(geometry, cells="hexahedra")
    assert mesh(geometry).cell_type.name == "ten-node tetrahedron"


def test_default_hexahedra_get_longer_where_they_would_be_too_many() -> None:
    geometry = HelicalPneuNet(length=352 * mm, chambers=34).build()
    size = default_size(geometry, "hexahedra")
    assert 3 * mm < size <= 4 * mm
    assert mesh(geometry, cells="hexahedra").unknown_count < SIZING.default_unknowns * 1.1


def test_a_face_can_have_a_smaller_size_and_the_shape_forgets_it() -> None:
    geometry = SMALL.build()
    plain = mesh(geometry, size=4 * mm)
    fine = mesh(geometry, size=4 * mm, face_sizes={"tip": 1 * mm})
    assert longest_edge(fine, "tip") < 1.8 * mm < longest_edge(plain, "tip")
    assert longest_edge(fine, "fixed") > 2.5 * mm
    again = mesh(geometry, size=4 * mm)
    assert np.array_equal(again.points, plain.points)


@pytest.mark.parametrize(
    ("settings", "facts"),
    [
        ({"size": -1 * mm}, ("size", "-1 mm", "0.291 mm to 20 mm")),
        ({"size": 30 * mm}, ("size", "30 mm", "0.291 mm to 20 mm")),
        ({"size": "2 kPa"}, ("mesh size", "2 kPa", "length")),
        ({"grading": 2}, ("grading", 2, "0.1 to 1")),
        ({"wall_cells": 0}, ("wall_cells is 0", "allowed is 1", "to 4")),
        ({"wall_cells": 5}, ("wall_cells is 5", "allowed is 1", "to 4")),
        ({"wall_cells": 1.5}, ("wall_cells is 1.5", "allowed is 1", "to 4")),
        ({"wall_cells": True}, ("wall_cells is True", "allowed is 1", "to 4")),
        ({"face_sizes": {"cavty": 1 * mm}}, ("cavty", "cavity")),
        ({"face_sizes": {"cavity": 0}}, ("cavity", "0 mm", "0.067 mm to 2 mm")),
        ({"face_sizes": {"cavity": 5 * mm}}, ("cavity", "5 mm", "0.067 mm to 2 mm")),
        ({"face_sizes": {"cavity": 1e-6}}, ("cavity", "0.001 mm", "0.067 mm to 2 mm")),
        ({"face_sizes": {"cavity": "1 kPa"}}, ("'cavity'", "1 kPa", "length")),
        ({"face_sizes": [1 * mm]}, ("face_sizes", "[0.001]")),
    ],
)
def test_what_no_mesh_can_be_made_with_is_refused(settings, facts: tuple) -> None:
    with refused(*facts):
        mesh(SMALL.build(), **settings)
