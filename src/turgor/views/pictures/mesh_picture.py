"""Picture of a mesh: the whole actuator with the edges of its cells, colored by their shape, as PNG."""

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

from turgor.core.meshing.cells import six_node_triangles
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import cell_shapes, film_shapes
from turgor.core.meshing.surface import corner_keys
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.foundation.errors import TurgorError
from turgor.views.pictures.colors import RUBBER
from turgor.views.pictures.framing import framed
from turgor.views.pictures.rendering import View, render
from turgor.views.pictures.skin import Skin, drawn_triangles, visible_skin
from turgor.views.plots.figures import check_ending, write_figure

Array = NDArray[np.float64]

#: Colors of cells of the shapes 0, 0.2, 0.4, and 0.6 or more: flat cells stand out, good ones have the color of rubber.
SHAPES = ("#a8202a", "#e07b39", "#f3d78b", RUBBER)
WORST_GOOD = 0.6
NOTE = "shape of the cells: 1 is regular, 0 is flat"


@dataclass(frozen=True, slots=True, kw_only=True)
class _AtRest:
    """An undeformed mesh with the attributes of a state that a skin needs."""

    mesh: Mesh
    facts: MeshFacts = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "facts", MeshFacts(self.mesh))

    @property
    def points(self) -> Array:
        return self.mesh.points


def write_mesh_picture(path: str | Path, mesh: Mesh, title: str = "", width: int = 1600) -> None:
    """Draw the cells of the whole actuator with their edges, colored by their shape (see `MeshQuality`), as PNG.

    Parameters
    ----------
    path : str or Path
        PNG file to write.
    mesh : Mesh
        What to draw; a half or quarter is mirrored.
    title : str
        Line above the actuator.
    width : int
        Width in pixels, 400 or more.
    """
    check_ending(path, "picture")
    write_figure(path, mesh_figure(mesh, title, width), kind="picture")


def mesh_figure(mesh: Mesh, title: str = "", width: int = 1600) -> Figure:
    """Draw the cells as `write_mesh_picture` does, and return the figure.

    Parameters
    ----------
    mesh, title, width
        See `write_mesh_picture`.

    Returns
    -------
    matplotlib.figure.Figure
    """
    if width < 400:
        raise TurgorError(f"picture width is {width} pixels; allowed is 400 or more.")
    skin = _cell_skin(mesh)
    plain = View(left=0.0, right=1.0, limit=WORST_GOOD)
    across, upward, _ = plain.eye.project(skin.points).T
    left, right = float(across.min()), float(across.max())
    view = replace(plain, left=left, right=right, height=float(np.ptp(upward)), width=width)
    colors = ScalarMappable(Normalize(0, WORST_GOOD), _colors())
    return framed(render([skin], view, _colors()), view, (title, NOTE), colors)


def _cell_skin(mesh: Mesh) -> Skin:
    """Skin in which each outer side of a cell is a patch with one value."""
    triangles, _ = drawn_triangles(mesh)
    skin = visible_skin(_AtRest(mesh=mesh), np.zeros(len(mesh.points)))
    copies = mesh.symmetry_factor
    pieces = len(skin.triangles) // (copies * len(triangles))
    nodes = len(skin.points) // (copies * len(triangles))
    per_side = len(mesh.cell_type.side.triangles)  # a quadrilateral is drawn as two triangles
    patch = np.arange(copies * len(triangles)) // per_side
    shapes = np.tile(_shapes_behind(mesh, triangles), copies)
    return replace(skin, patch=np.repeat(patch, pieces), values=np.repeat(shapes, nodes))


def _shapes_behind(mesh: Mesh, triangles: NDArray[np.int64]) -> Array:
    """Shape of the cell behind each outer triangle, or of the side of a film that it is a part of, (f,)."""
    if not len(mesh.cells):
        return np.repeat(film_shapes(mesh), len(mesh.cell_type.side.triangles))
    sides = mesh.cells[:, np.array(mesh.cell_type.sides)]
    owner = np.repeat(np.arange(len(mesh.cells)), sides.shape[1] * len(mesh.cell_type.side.triangles))
    keys = corner_keys(six_node_triangles(sides.reshape(-1, sides.shape[2])), len(mesh.points))
    order = np.argsort(keys)
    place = np.searchsorted(keys[order], corner_keys(triangles, len(mesh.points)))
    return np.asarray(cell_shapes(mesh)[owner[order[place]]])


def _colors() -> Colormap:
    return LinearSegmentedColormap.from_list("shape", SHAPES)
