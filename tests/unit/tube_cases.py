"""What the tests of tubes and single-chamber benders share: areas of named faces, volumes of a mesh."""

from collections.abc import Mapping

import pytest

from turgor.core.engine.faces.surfaces import enclosed_volume
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes


def areas(geometry: Geometry) -> dict[str, float]:
    """Area of each named face in mm², faces between two solids once."""
    total: dict[str, float] = {}
    for face in set(geometry.shape.faces):
        total[face.name] = total.get(face.name, 0.0) + face.mass
    return total


def assert_cavity_between(geometry: Geometry, name: str, low: tuple[float, ...], high: tuple[float, ...]) -> None:
    """Compare the box around a cavity's faces with corners in mm."""
    boxes = [face.bounding_box for face in geometry.shape.faces if face.name == name]
    assert [min(box[0][axis] for box in boxes) for axis in range(3)] == pytest.approx(low, abs=1e-4)
    assert [max(box[1][axis] for box in boxes) for axis in range(3)] == pytest.approx(high, abs=1e-4)


def assert_shape(actuator, *, solid: float, cavities: Mapping[str, float], regions: set[str], faces: set[str]) -> None:
    """Build and compare with volumes in mm³, computed by hand, and with names."""
    geometry = actuator.build()  # compares the volumes of CAD and dimensions
    assert actuator.solid_volume * 1e9 == pytest.approx(solid, rel=1e-12)
    assert {name: value * 1e9 for name, value in actuator.cavity_volumes.items()} == pytest.approx(cavities, rel=1e-12)
    assert geometry.solid_volume == actuator.solid_volume
    assert geometry.cavity_volumes == actuator.cavity_volumes
    assert geometry.smallest_wall == actuator.smallest_wall
    assert set(geometry.regions) == regions
    assert set(geometry.faces) == faces
    assert all(solid.mass > 0 for solid in geometry.shape.solids)


def assert_meshes(actuator, *, size: float, rel: float = 0.02) -> None:
    """Mesh coarsely: the cells fill the solid, the named cavity faces enclose the cavities, no name is lost."""
    geometry = actuator.build()
    made = mesh(geometry, size=size)
    assert cell_volumes(made).sum() == pytest.approx(geometry.solid_volume, rel=rel)
    for name, volume in geometry.cavity_volumes.items():
        assert -enclosed_volume(made.points, made.face(name)) == pytest.approx(volume, rel=rel)
    assert set(made.faces) == set(geometry.faces)
    assert set(made.regions) == set(geometry.regions)
