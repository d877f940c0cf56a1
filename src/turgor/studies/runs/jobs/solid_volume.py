"""Volume of the solid material of a part: a column of designs, and a measure that can be differentiated."""

from turgor.core.engine.mass import cell_volumes
from turgor.core.meshing.mesh import Mesh
from turgor.core.results.measures.measure import Measure

#: Name of the column and of the measure.
SOLID_VOLUME = "solid_volume"


def solid_volume_of(mesh: Mesh) -> float:
    """Return the volume of the material of the whole part [m³]."""
    return float(cell_volumes(mesh).sum()) * mesh.symmetry_factor


def solid_volume() -> Measure:
    """Return the measure of the volume, which has the same value at every state."""
    return Measure(
        name=SOLID_VOLUME, unit="mL", function=lambda at: solid_volume_of(at.state.model.mesh),
        definition="volume of the solid material",
    )  # fmt: skip
