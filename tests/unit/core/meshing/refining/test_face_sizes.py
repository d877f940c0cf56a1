"""Hexahedra follow sizes of faces: across the section, along the sweep, and in the meridian of a revolved body."""

import numpy as np
import pytest

import turgor as tg
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.core.meshing.refining.split_hexahedra import SIDE_EDGES
from turgor.units import MPa, kPa, mm


def edge_lengths(mesh, name):
    """Lengths of the edges on a face, by their direction in its sides."""
    sides = mesh.face(name)
    return [
        np.concatenate([np.linalg.norm(mesh.points[sides[:, b]] - mesh.points[sides[:, a]], axis=1) for a, b in group])
        for group in SIDE_EDGES
    ]


@pytest.mark.parametrize(
    ("actuator", "face", "size"),
    [
        (tg.FastPneuNet(chambers=2, length=20 * mm), "cavity", 1 * mm),
        (tg.FastPneuNet(chambers=2, length=20 * mm), "tip", 1 * mm),
        (tg.actuators.EccentricBender(), "cavity", 1.2 * mm),
        (tg.actuators.SemicircularBender(length=40 * mm), "strain_limiting_layer", 1.5 * mm),
    ],
)
def test_edges_on_a_face_are_as_short_as_asked_for(actuator, face, size):
    part = actuator.build()
    plain = tg.mesh(part, cells="hexahedra")
    made = tg.mesh(part, cells="hexahedra", face_sizes={face: size})
    assert max(lengths.max() for lengths in edge_lengths(plain, face)) > 1.1 * size, "there is something to do"
    assert max(lengths.max() for lengths in edge_lengths(made, face)) <= size * (1 + 1e-6)
    assert set(made.faces) == set(plain.faces)
    assert cell_volumes(made).sum() == pytest.approx(cell_volumes(plain).sum(), rel=1e-9)


def test_a_size_that_is_met_changes_nothing():
    part = tg.FastPneuNet(chambers=2, length=20 * mm).build()
    plain = tg.mesh(part, size=3 * mm, cells="hexahedra")
    made = tg.mesh(part, size=3 * mm, cells="hexahedra", face_sizes={"cavity": 3 * mm})
    np.testing.assert_array_equal(made.points, plain.points)


def test_the_meridian_follows_sizes_and_its_rings_stay():
    part = tg.actuators.BellowsOfRevolution(folds=1).build()
    plain = tg.mesh(part, size=3 * mm, cells="axisymmetric")
    made = tg.mesh(part, size=3 * mm, cells="axisymmetric", face_sizes={"cavity": 0.8 * mm})
    along = np.concatenate(edge_lengths(made, "cavity"))
    assert plain.unknown_count < made.unknown_count < 4 * plain.unknown_count
    assert along.min() < 0.8 * mm
    values = []
    for mesh in (plain, made):
        rubber = tg.Material(law=tg.laws.NeoHooke(C10=0.1 * MPa), name="rubber")
        materials = dict.fromkeys(mesh.regions, rubber)
        model = tg.Model(mesh, materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", 1 * kPa)])
        response = tg.measure(tg.solve(model), tg.measures.tip_displacement_x, mesh_error=False)
        values.append(response.find("tip_displacement_x").values[-1])
    assert values[1] == pytest.approx(values[0], rel=0.02)
    assert values[1] != values[0]
