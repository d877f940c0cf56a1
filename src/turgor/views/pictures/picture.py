"""Picture: an image of an actuator, shown by notebooks and written as PNG."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from matplotlib.figure import Figure

from turgor.core.geometry.cad.facets import named_facets
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.exchange.mesh_file import MeshedShape
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.model import Model
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.solvers.solution import Solution, State
from turgor.foundation.errors import TurgorError
from turgor.units import kPa
from turgor.views.pictures.colors import VON_MISES, Field
from turgor.views.pictures.mesh_picture import mesh_figure
from turgor.views.pictures.state_picture import Style, shared_view, state_figure
from turgor.views.plots.figures import check_ending, png_of


class _Look(NamedTuple):
    """How something is drawn."""

    color_by: str | Field
    title: str | None
    width: int
    style: Style | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A PNG picture and what it shows.

    Parameters
    ----------
    caption : str
        What the picture shows.
    png : bytes
        Content of the PNG file.
    """

    caption: str
    png: bytes = field(repr=False)

    def _repr_png_(self) -> bytes:
        """Return what a notebook shows."""
        return self.png

    def write(self, path: str | Path) -> Path:
        """Write the picture as a PNG file.

        Parameters
        ----------
        path : str or Path
            File to write; ends in ``.png``.

        Returns
        -------
        Path
        """
        path = Path(path)
        check_ending(path, "picture")
        path.write_bytes(self.png)
        return path


def picture(
    of: Solution | State | Model | Mesh | Geometry,
    path: str | Path | None = None,
    *,
    state: int = -1,
    color_by: str | Field = VON_MISES,
    title: str | None = None,
    width: int = 1200,
    style: Style | None = None,
) -> Picture:
    """Draw the whole actuator at true scale: a state, the cells of a mesh, or the named faces of a geometry.

    A notebook shows the picture that is returned.

    Parameters
    ----------
    of : Solution, State, Model, Mesh or Geometry
        What to draw. The outline of the actuator at rest is drawn behind a state of a solution. States and meshes of a
        half or a quarter are mirrored.
    path : str or Path, optional
        PNG file to write.
    state : int
        Which state of a solution; by default the last one.
    color_by : str or Field
        Colors of a state: ``"von_mises"``, ``"contact_pressure"``, ``"stretch"``, ``"principal_stress"``,
        ``"mean_stress"``, ``"displacement"``, ``"fiber_tension"``, or a `turgor.pictures.Field` of your own.
    title : str, optional
        Line above the actuator; by default the name of the actuator and, for a state, what acts.
    width : int
        Width in pixels, 400 or more.
    style : Style, optional
        Of a state: cut away, transparent, with the edges of cells; see `turgor.pictures.Style`.

    Returns
    -------
    Picture

    Raises
    ------
    TurgorError
        If there is no such state, or the path does not end in ``.png``.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> picture(FastPneuNet(chambers=2, length=20e-3).build(), width=400)
    Picture(caption='fast PneuNet, 2 chambers, half')
    """
    if path is not None:
        check_ending(path, "picture")
    name, figure = _drawn(of, state, _Look(color_by, title, width, style))
    picture = Picture(caption=name, png=png_of(figure))
    if path is not None:
        picture.write(path)
    return picture


def _drawn(of: Solution | State | Model | Mesh | Geometry, number: int, look: _Look) -> tuple[str, Figure]:
    """Caption and figure of anything that has a picture."""
    color_by, title, width, style = look
    match of:
        case Solution():
            return _of_solution(of, number, look)
        case State():
            name = caption(of) if title is None else title
            return name, state_figure(of, shared_view([of], width, color_by), title=name, style=style)
        case Mesh() | Model():
            mesh = of if isinstance(of, Mesh) else of.mesh
            name = mesh.name if title is None else title
            return name, mesh_figure(mesh, name, width)
        case Geometry():
            name = of.name if title is None else title
            return name, geometry_figure(of, name, width)
        case _:
            raise TurgorError(
                f"there is no picture of a {type(of).__name__}; a solution, a state, a model, a mesh or a geometry "
                "is needed."
            )


def caption(state: State) -> str:
    """Return one line about a state: name of the actuator, stage, time, and pressures or load factor.

    Parameters
    ----------
    state : State

    Returns
    -------
    str
    """
    acting = ", ".join(
        f"{'' if len(state.pressures) == 1 else face + ' '}{pressure / kPa:.4g} kPa"
        for face, pressure in state.pressures.items()
    )
    time = "" if state.time is None else f"{state.time:.4g} s"
    parts = (state.model.mesh.name, state.stage, time, acting or f"load factor {state.load_factor:.4g}")
    return " · ".join(part for part in parts if part)


def geometry_figure(geometry: Geometry, title: str, width: int) -> Figure:
    """Draw a geometry from two sides with its named faces; a geometry that was read as a mesh is drawn as a mesh.

    Parameters
    ----------
    geometry : Geometry
        What to draw.
    title : str
        Line above the views.
    width : int
        Width in pixels.

    Returns
    -------
    matplotlib.figure.Figure
    """
    shape = geometry._cad
    if isinstance(shape, MeshedShape):
        return mesh_figure(shape.mesh, title, width)
    faces = [(name, corners * geometry.length_scale) for name, corners in named_facets(shape) if len(corners)]
    # a local import, because it loads the CAD kernel, which a run does not need
    from turgor.views.pictures.cad_picture import named_faces_figure

    figure = named_faces_figure(title, faces)
    figure.set_dpi(width / figure.get_figwidth())
    return figure


def _of_solution(path: Solution, number: int, how: _Look) -> tuple[str, Figure]:
    """Caption and figure of one state of a solution, with the outline of the state at rest behind it."""
    count = len(path.states)
    if not -count <= number < count:
        raise TurgorError(f"state is {number}; the solution has {count} states, 0 to {count - 1} (or -1, the last).")
    color_by, title, width, style = how
    facts = MeshFacts(path.model.mesh)
    first, chosen = (StateFields(path.states[i], facts) for i in (0, number))
    name = caption(path.states[number]) if title is None else title
    ghost = None if number % count == 0 else first
    view = shared_view([first, chosen], width, color_by)
    return name, state_figure(chosen, view, title=name, ghost=ghost, style=style)
