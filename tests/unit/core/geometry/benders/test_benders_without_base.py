"""Benders with base = 0: the strain-limiting layer is their bottom."""

import numpy as np
import pytest
from turgor.actuators import RectangularBender, SemicircularBender

import turgor as tg
from refused import refused
from turgor.core.meshing.cells import six_node_triangles
from turgor.core.meshing.quality.facing_walls import unit_normals
from turgor.units import MPa, kPa, mm

KINDS = (RectangularBender, SemicircularBender)


def area(mesh, name):
    """Area of a plane face at z = 0 [m²]."""
    corners = mesh.points[six_node_triangles(mesh.face(name))[:, :3]]
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("clamp_length", [0.0, 10 * mm])
def test_the_layer_is_the_bottom_up_to_the_block(kind, clamp_length):
    bender = kind(base=0.0, length=40 * mm, clamp_length=clamp_length)
    part = bender.build()
    assert part.regions == ("body",)
    half_width = bender.width / 2 if isinstance(bender, RectangularBender) else bender.radius + bender.wall
    for cells in ("tetrahedra", "hexahedra"):
        made = tg.mesh(part, cells=cells)
        assert area(made, "strain_limiting_layer") == pytest.approx(40 * mm * half_width, rel=1e-9)
        normals = unit_normals(made.points, six_node_triangles(made.face("strain_limiting_layer")))
        np.testing.assert_allclose(normals, np.broadcast_to([0, 0, -1.0], normals.shape), atol=1e-9)


@pytest.mark.parametrize("kind", [RectangularBender, pytest.param(SemicircularBender, marks=pytest.mark.slow)])
def test_without_base_a_bender_bends_further(kind):
    rubber = tg.Material(law=tg.laws.NeoHooke(C10=0.2 * MPa), name="rubber")
    paper = tg.Shell(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm)
    angles = []
    for base in (1.5 * mm, 0.0):
        made = tg.mesh(kind(base=base, length=40 * mm).build(), cells="hexahedra")
        materials = dict.fromkeys(made.regions, rubber) | {"strain_limiting_layer": paper}
        model = tg.Model(made, materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", 10 * kPa)])
        response = tg.measure(tg.solve(model), tg.bending_angle, mesh_error=False)
        angles.append(response.find("bending_angle").values[-1])
    assert 0 < 1.05 * angles[0] < angles[1]


@pytest.mark.parametrize("kind", KINDS)
def test_a_base_is_none_or_a_thickness(kind):
    with refused("base", "-1 mm", "0 (none) or 0.01 mm"):
        kind(base=-1 * mm)
