"""Swept meshes fill the same shape as the CAD solids: volumes, cavities, faces, names, for every family and option."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.faces.surfaces import area, enclosed_volume
from turgor.core.geometry.actuators.bellows_of_revolution import BellowsOfRevolution
from turgor.core.geometry.actuators.bidirectional_bender import BidirectionalBender
from turgor.core.geometry.actuators.bidirectional_pneunet import BidirectionalPneuNet
from turgor.core.geometry.actuators.contracting_tube import ContractingTube
from turgor.core.geometry.actuators.eccentric_bender import EccentricBender
from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.actuators.fiber_reinforced_bender import FiberReinforcedBender
from turgor.core.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.core.geometry.actuators.free_bottom_pneunet import FreeBottomPneuNet
from turgor.core.geometry.actuators.helical_pneunet import HelicalPneuNet
from turgor.core.geometry.actuators.manta_fin import MantaFin
from turgor.core.geometry.actuators.omnidirectional_actuator import OmnidirectionalActuator
from turgor.core.geometry.actuators.parallel_bellows import ParallelBellows
from turgor.core.geometry.actuators.rectangular_bender import RectangularBender
from turgor.core.geometry.actuators.semicircular_bender import SemicircularBender
from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
from turgor.core.geometry.actuators.three_extenders import ThreeExtenders
from turgor.core.geometry.actuators.trapezoidal_pneunet import TrapezoidalPneuNet
from turgor.core.geometry.actuators.triangular_pneunet import TriangularPneuNet
from turgor.core.geometry.actuators.twisting_tube import TwistingTube
from turgor.core.geometry.actuators.two_material_bender import TwoMaterialBender
from turgor.core.meshing.cells import HEXAHEDRON, six_node_triangles
from turgor.core.meshing.default_settings import chosen_settings
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes, quality
from turgor.core.meshing.quality.checks import check_mesh
from turgor.core.meshing.settings import MeshSettings
from turgor.units import mm

#: Straight shapes are exact; quadratic edges follow circles to a few parts in 10,000 at these sizes.
FLAT, CURVED = 1e-11, 1e-3

SHORT = {"chambers": 2, "length": 24 * mm}

FLAT_SHAPES = {
    "fast": FastPneuNet(**SHORT),
    "fast, whole, clamped": FastPneuNet(**SHORT, symmetric=False, clamp_length=4 * mm),
    "slow, clamped": SlowPneuNet(**SHORT, clamp_length=4 * mm),
    "free bottom": FreeBottomPneuNet(**SHORT),
    "helical": HelicalPneuNet(**SHORT),
    "helical, clamped": HelicalPneuNet(**SHORT, clamp_length=4 * mm),
    "bidirectional": BidirectionalPneuNet(**SHORT),
    "trapezoidal": TrapezoidalPneuNet(chambers=2, length=40 * mm),
    "triangular, clamped": TriangularPneuNet(chambers=2, length=40 * mm, clamp_length=4 * mm),
    "manta fin": MantaFin(chambers=2, length=30 * mm),
    "manta fin, clamped": MantaFin(chambers=2, length=30 * mm, clamp_length=4 * mm),
    "rectangular": RectangularBender(length=30 * mm),
    "two chambers": BidirectionalBender(length=30 * mm),
}

CURVED_SHAPES = {
    "fast, inlet": FastPneuNet(**SHORT, inlet_diameter=3 * mm, clamp_length=4 * mm),
    "semicircular": SemicircularBender(length=30 * mm),
    "semicircular, clamped, inlet": SemicircularBender(
        length=30 * mm, clamp_length=6 * mm, inlet_diameter=2 * mm, symmetric=False
    ),
    "eccentric": EccentricBender(length=30 * mm),
    "two materials": TwoMaterialBender(length=30 * mm),
    "extending": ExtendingCylinder(length=30 * mm),
    "extending, whole, inlet": ExtendingCylinder(length=30 * mm, symmetric=False, inlet_diameter=3 * mm),
    "contracting": ContractingTube(length=30 * mm),
    "twisting": TwistingTube(length=30 * mm),
    "skin": FiberReinforcedCylinder(length=30 * mm, skin=1 * mm),
    "bender with skin": FiberReinforcedBender(length=30 * mm, skin=1 * mm),
    "three circles": OmnidirectionalActuator(length=30 * mm),
    "half circles": OmnidirectionalActuator(length=30 * mm, chamber_shape="semicircular_flat_outward", symmetric=True),
    "ring sectors, bore": OmnidirectionalActuator(
        length=30 * mm, chamber_shape="ring_sector", chamber_size=4 * mm, bore_radius=3 * mm, clamp_length=4 * mm
    ),
    "three extenders": ThreeExtenders(length=40 * mm),
    "bellows": BellowsOfRevolution(folds=1),
    "bellows, whole, inlet": BellowsOfRevolution(folds=1, symmetric=False, inlet_diameter=4 * mm, clamp_length=5 * mm),
    "straight bellows, half": BellowsOfRevolution(folds=1, fold_shape="straight", quarter=False),
}

SHAPES = [(name, shape, FLAT) for name, shape in FLAT_SHAPES.items()]
SHAPES += [(name, shape, CURVED) for name, shape in CURVED_SHAPES.items()]


@pytest.mark.parametrize(("shape", "tolerance"), [case[1:] for case in SHAPES], ids=[case[0] for case in SHAPES])
def test_the_mesh_is_the_shape_of_the_dimensions(shape, tolerance: float) -> None:
    geometry = shape.build()
    made = mesh(geometry, size=3 * mm, cells="hexahedra")
    assert made.cell_type is HEXAHEDRON
    assert cell_volumes(made).sum() == pytest.approx(geometry.solid_volume, rel=tolerance)
    for name, volume in geometry.cavity_volumes.items():
        walls = six_node_triangles(made.face(name))
        assert -enclosed_volume(made.points, walls) == pytest.approx(volume, rel=tolerance)
    results = {name: area(made.points, six_node_triangles(face)) for name, face in made.faces.items()}
    expected: dict[str, float] = {}
    for face in set(geometry.shape.faces):
        expected[face.name] = expected.get(face.name, 0.0) + face.mass * mm**2
    assert results == pytest.approx(expected, rel=max(tolerance, 1e-8))  # CAD areas of slanted faces are good to 1e-8
    assert tuple(made.regions) == geometry.regions
    assert [finding.code for finding in check_mesh(made) if finding.code not in ("G01", "D01")] == []
    assert quality(made).min_jacobian_ratio > 0


def test_names_are_those_of_the_tetrahedra() -> None:
    geometry = FastPneuNet(**SHORT).build()
    swept, free = mesh(geometry, size=3 * mm, cells="hexahedra"), mesh(geometry, size=3 * mm)
    assert sorted(swept.faces) == sorted(free.faces)
    assert list(swept.regions) == list(free.regions)


def test_cells_of_the_default_pneunet_are_counted_by_hand() -> None:
    # along: 2 | 7.5 in 4 | 1 | 1 | 1 | 7.5 in 4 | 2, across: 1.5 | 1 | 5.5 in 3 | 2, up: 1.5 | 1.5 | 2 | 1 | 7 in 4 | 2
    made = mesh(FastPneuNet(chambers=2, length=22 * mm).build(), size=4 * mm, cells="hexahedra")
    slab, walls, chambers, gap = 13 * 6 * 2, 4 * (6 * 7) - 2 * 1, 8 * (6 * 7 - 5 * 6), 2 * 2 - 1
    assert len(made.cells) == slab + walls + chambers + gap


def test_more_cells_through_a_wall_on_request() -> None:
    geometry = FastPneuNet(**SHORT).build()
    two = mesh(geometry, size=4 * mm, cells="hexahedra", wall_cells=2)
    assert [finding.code for finding in check_mesh(two)] == []
    one = mesh(geometry, size=4 * mm, cells="hexahedra")
    (result,) = check_mesh(one)
    assert result.code == "G01"
    assert "wall_cells = 2" in result.advice


def test_nodes_of_a_tube_lie_on_its_circles() -> None:
    tube = TwistingTube(length=30 * mm)
    made = mesh(tube.build(), size=3 * mm, cells="hexahedra")
    radius = np.hypot(*made.points[made.face_nodes("cavity")][:, 1:].T)
    x = made.points[made.face_nodes("cavity")][:, 0]
    along = np.abs(x - 15 * mm) < 9 * mm  # away from the end walls
    assert radius[along] == pytest.approx(tube.inner_radius, rel=1e-12)


def test_a_layer_within_one_region_is_a_face_of_its_own() -> None:
    made = mesh(BidirectionalBender(length=30 * mm).build(), size=3 * mm, cells="hexahedra")
    layer = made.face("strain_limiting_layer")
    assert tuple(made.regions) == ("body",)
    assert made.points[np.unique(layer), 2] == pytest.approx(0.0, abs=1e-12)


def test_the_same_settings_give_the_same_mesh() -> None:
    first, second = (mesh(SemicircularBender().build(), size=4 * mm, cells="hexahedra") for _ in range(2))
    assert (first.points == second.points).all()
    assert (first.cells == second.cells).all()


def test_what_is_no_sweep_says_so() -> None:
    with refused("bellows, unconstrained", "hexahedra", "PneuNets"):
        mesh(ParallelBellows().build(), size=3 * mm, cells="hexahedra")
    with refused("helical PneuNet, 11 chambers", "hexahedra"):
        mesh(HelicalPneuNet(inlet_diameter=3 * mm).build(), size=3 * mm, cells="hexahedra")


def test_unknown_cells_and_sizes_of_faces_are_refused() -> None:
    geometry = FastPneuNet(**SHORT).build()
    with refused("hexaedra", "hexahedra"):
        mesh(geometry, size=3 * mm, cells="hexaedra")
    with refused("outside", "0.12 mm", "6.9 million", "hexahedra"):
        mesh(geometry, size=3 * mm, cells="hexahedra", face_sizes={"outside": 0.12 * mm})
    with refused("mesh size", "40 mm", "0.305 mm to 24 mm"):
        mesh(geometry, size=40 * mm, cells="hexahedra")


def test_a_turn_is_counted_in_quarters() -> None:
    whole, half, quarter = (
        mesh(BellowsOfRevolution(folds=1, symmetric=s, quarter=q).build(), size=4 * mm, cells="hexahedra")
        for s, q in ((False, False), (True, False), (True, True))
    )
    assert len(whole.cells) == 2 * len(half.cells) == 4 * len(quarter.cells)


@pytest.mark.parametrize(
    ("kind", "cells"),
    [("FiberReinforcedBender", "tetrahedra"), ("SemicircularBender", "hexahedra"), ("FastPneuNet", "hexahedra")],
)
def test_sections_of_paired_triangles_get_tetrahedra_where_hexahedra_are_too_many(kind: str, cells: str) -> None:
    geometry = getattr(tg.actuators, kind)().build()
    assert chosen_settings(geometry, MeshSettings()).cells == cells
