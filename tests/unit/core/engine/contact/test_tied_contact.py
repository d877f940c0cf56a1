"""Contact next to a tie: sides that are tied touch nothing, and what is left of both faces may."""

import numpy as np

import meshes
import turgor as tg
from turgor.core.engine.contact.build import outer_sides
from turgor.core.engine.contact.surface import of_face, whole_surface
from turgor.core.engine.mass import cell_volumes
from turgor.units import kPa, mm


def test_the_rest_of_a_tied_face_may_touch():
    plate = meshes.box((20 * mm, 10 * mm, 4 * mm), (4, 2, 1))
    lid = tg.bodies.placed(meshes.box((10 * mm, 10 * mm, 2 * mm), (3, 3, 1)), shift=(0, 0, 4 * mm))
    mesh = tg.bodies.together({"plate": plate, "lid": lid})
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=50 * kPa))
    supports = [tg.Fixed("z0_plate"), tg.supports.Tied("z0_lid", "z1_plate")]
    model = tg.Model(mesh, dict.fromkeys(mesh.regions, rubber), supports, [])
    surface = whole_surface(model, mesh.points, cell_volumes(mesh), 1.0)
    outer = outer_sides(model, surface)
    assert not outer[of_face(mesh, surface, "z0_lid")].any()
    top = of_face(mesh, surface, "z1_plate")
    beyond = mesh.points[surface.sides].mean(axis=1)[:, 0] > 10 * mm
    assert np.array_equal(outer[top], beyond[top])
