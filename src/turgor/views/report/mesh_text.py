"""Describe a mesh as lines of text: counts, sizes, shapes of the cells."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import cell_shapes, jacobian_ratios, quality
from turgor.units import mm
from turgor.views.report.settings import PAGE


def describe_mesh(mesh: Mesh) -> str:
    """Describe a mesh: counts, names, lengths of the edges, shapes and Jacobian ratios of the cells.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    str
        Lines of text.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> print(describe_mesh(mesh(FastPneuNet(chambers=2, length=20e-3).build(), size=3e-3)).splitlines()[0])
    fast PneuNet, 2 chambers, half
    """
    stats = quality(mesh)
    regions = ", ".join(f"{name} {len(cells):,} cells" for name, cells in mesh.regions.items())
    faces = ", ".join(f"{name} {len(sides):,}" for name, sides in mesh.faces.items())
    lengths = ", ".join(f"{length / mm:.3g}" for length in (stats.min_edge, stats.mean_edge, stats.max_edge))
    return "\n".join(
        [
            mesh.name,
            f"  {stats.cells:,} cells ({mesh.cell_type.name}), {stats.points:,} nodes, {stats.unknowns:,} unknowns",
            f"  regions: {regions}",
            f"  faces, sides of cells ({mesh.cell_type.side.name}): {faces}",
            f"  shortest, mean and longest edge: {lengths} mm",
            f"  shape of the cells (1 is regular, 0 is flat): worst {stats.min_shape:.2g}, mean {stats.mean_shape:.2g}",
            *_histogram(cell_shapes(mesh)),
            f"  Jacobian ratio of the curved cells (1 is straight): worst {stats.min_jacobian_ratio:.2g}",
            *(bars if len(bars := _histogram(jacobian_ratios(mesh))) > 1 else ()),
        ]
    )


def _histogram(values: NDArray[np.float64]) -> list[str]:
    """Bars from 0 to 1, the empty ones at the lower end left out."""
    counts, ends = np.histogram(np.clip(values, 0, 1), range=(0, 1))
    first = int(np.flatnonzero(counts)[0])
    bars = [max(1, round(PAGE.longest_bar * count / counts.max())) if count else 0 for count in counts]
    return [
        f"    {ends[i]:.1f} to {ends[i + 1]:.1f} {counts[i]:>8,} {'#' * bars[i]}".rstrip()
        for i in range(first, len(counts))
    ]
