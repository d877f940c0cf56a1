"""Measures of stress and stretch: what 99 % of the volume stay below, in the solid and in each region, and the maxima.

The maximum over the quadrature points does not converge: at a sharp edge, at a clamped rim, or where two materials
meet, the exact stress is unbounded, so every finer mesh gives a larger value. The value that 99 % of the volume stay
below does not depend on a few cells, and converges.
"""

import re

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.percentiles import PERCENTILE, volume_percentile
from turgor.core.meshing.mesh import Mesh
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measure import Measure
from turgor.foundation.errors import unknown

_GROWS = "grows without limit at sharp edges and clamped rims as the mesh is refined"

principal_stretch_p99 = Measure(
    name="principal_stretch_p99", unit="", function=lambda at: at.stretch_p99,
    definition=f"principal stretch that {PERCENTILE} % of the volume of the solid, before it deforms, stay below",
    local=True,
)  # fmt: skip
von_mises_p99 = Measure(
    name="von_mises_p99", unit="kPa", function=lambda at: at.von_mises_p99,
    definition=f"von Mises stress that {PERCENTILE} % of the volume of the solid, before it deforms, stay below; "
    "membranes and fibers left out",
    local=True,
)  # fmt: skip
maximum_principal_stretch = Measure(
    name="maximum_principal_stretch", unit="", function=lambda at: float(at.cells.stretch.max()),
    definition=f"largest principal stretch at any quadrature point of the solid; {_GROWS}",
    local=True,
)  # fmt: skip
maximum_von_mises = Measure(
    name="maximum_von_mises", unit="kPa", function=lambda at: float(at.cells.von_mises.max()),
    definition="largest von Mises stress at any quadrature point of the solid, membranes and fibers left out; "
    f"{_GROWS}",
    local=True,
)  # fmt: skip

#: Measures that each region has by itself too.
BY_REGION: tuple[Measure, ...] = (principal_stretch_p99, von_mises_p99)

#: Measures of the whole solid, which every mesh has.
OF_ANY_MESH: tuple[Measure, ...] = (*BY_REGION, maximum_principal_stretch, maximum_von_mises)


def principal_stretch_in(region: str) -> Measure:
    """Make the measure of the largest principal stretch in a region that 99 % of its volume stay below.

    Examples
    --------
    >>> principal_stretch_in("base").name
    'base_principal_stretch_p99'
    """
    return Measure(
        name=f"{as_column(region)}_{principal_stretch_p99.name}", unit=principal_stretch_p99.unit,
        function=lambda at: volume_percentile(at.cells, at.cells.stretch, _cells_of(at, region)),
        definition=f"largest principal stretch that {PERCENTILE} % of the volume of the region {region} stay below",
        local=True,
    )  # fmt: skip


def von_mises_in(region: str) -> Measure:
    """Make the measure of the von Mises stress in a region that 99 % of its volume stay below.

    Examples
    --------
    >>> von_mises_in("base").name
    'base_von_mises_p99'
    """
    return Measure(
        name=f"{as_column(region)}_{von_mises_p99.name}", unit=von_mises_p99.unit,
        function=lambda at: volume_percentile(at.cells, at.cells.von_mises, _cells_of(at, region)),
        definition=f"von Mises stress that {PERCENTILE} % of the volume of the region {region} stay below",
        local=True,
    )  # fmt: skip


def in_region(name: str) -> Measure | None:
    """Return the measure of a region by its name, such as ``base_von_mises_p99``; None for other names.

    Examples
    --------
    >>> in_region("base_von_mises_p99").unit
    'kPa'
    """
    for whole, make in ((principal_stretch_p99, principal_stretch_in), (von_mises_p99, von_mises_in)):
        region = name.removesuffix(f"_{whole.name}")
        if region != name:
            return make(region)
    return None


def in_each_region(whole: Measure, mesh: Mesh) -> list[Measure]:
    """Return the measures of the regions that belong to one of the solid; none where there is one region only."""
    if whole not in BY_REGION or len(mesh.regions) < 2:
        return []
    make = von_mises_in if whole is von_mises_p99 else principal_stretch_in
    return [make(region) for region in mesh.regions]


def as_column(name: str) -> str:
    """Return the name of a face or region as a part of the name of a column: letters, digits and underscores only.

    Examples
    --------
    >>> as_column("upper-wall")
    'upper_wall'
    """
    return re.sub(r"\W", "_", name)


def _cells_of(at: StateFields, region: str) -> NDArray[np.int64]:
    for name, cells in at.mesh.regions.items():
        if region in (name, as_column(name)):
            return cells
    raise unknown("region", region, at.mesh.regions)
