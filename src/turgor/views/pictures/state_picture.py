"""Pictures of states: the whole actuator at true scale, colored by von Mises stress or contact pressure, as PNG."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.image import imsave
from numpy.typing import NDArray

from turgor.core.engine.percentiles import weighted_percentile
from turgor.core.results.drive import face_of, pressures_in
from turgor.core.results.fields.contact import extents_of
from turgor.core.results.fields.fibers import maximum_tension, threads_with_tension
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.solution import State
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import COLUMN_UNITS, Response
from turgor.units import deg, kPa
from turgor.views.pictures.colors import (
    CONTACT_PRESSURE,
    DIVERGING,
    FIBER_TENSION,
    VON_MISES,
    Field,
    field_of,
    plain_rubber,
)
from turgor.views.pictures.cuts import Cut, cut_away
from turgor.views.pictures.framing import bar_of, framed
from turgor.views.pictures.overlays.contact_patches import contact_skin, pressed
from turgor.views.pictures.overlays.obstacle_skin import obstacle_skin
from turgor.views.pictures.rendering import Overlays, View, frame, render
from turgor.views.pictures.settings import FRAMING, RENDERING
from turgor.views.pictures.skin import Skin, cavity_parts, visible_skin
from turgor.views.plots.figures import check_ending, write_figure

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Style:
    """How a picture shows an actuator, besides direction, scale and colors.

    Parameters
    ----------
    cut : Cut or str or None
        Plane of the undeformed actuator in front of which it is cut away; ``"y"`` is the middle plane across y.
    transparent : bool
        Whether the walls of cavities are seen through the body, and have the colors.
    edges : bool
        Whether the edges of cells are drawn.

    Raises
    ------
    TurgorError
        If a transparent body is cut, too.

    Examples
    --------
    >>> Style(cut="y").plane
    Cut(axis='y', position=None)
    """

    cut: Cut | str | None = None
    transparent: bool = False
    edges: bool = False

    def __post_init__(self) -> None:
        if self.plane is not None and self.transparent:
            raise TurgorError("a picture is either cut away or transparent; leave one out.")

    @property
    def plane(self) -> Cut | None:
        """The plane of the cut."""
        return Cut(axis=self.cut) if isinstance(self.cut, str) else self.cut


def shared_view(states: Sequence[State | StateFields], width: int = 1600, color_by: str | Field = VON_MISES) -> View:
    """Choose a view that shows all states completely, at the same scale and with the same colors.

    The color bar ends at the largest `von_mises_p99` of the states (99 % of the volume have a smaller stress), or at
    the 99th percentile of the contact pressure over the contact area. Larger values have the last color.

    Parameters
    ----------
    states : sequence of State or StateFields
        States of the pictures, usually the undeformed and the last one.
    width : int
        Width of the pictures in pixels, 400 or more.
    color_by : str or Field
        ``"von_mises"``, ``"contact_pressure"``, ``"stretch"``, ``"principal_stress"``, ``"mean_stress"``,
        ``"displacement"``, ``"fiber_tension"``, or a field of your own.
    """
    if width < 400:
        raise TurgorError(f"picture width is {width} pixels; allowed is 400 or more.")
    shown_field = field_of(color_by)
    if not states:
        raise TurgorError("a view needs at least one state to show.")
    shown = [_fields(state) for state in states]
    extents = extents_of(shown)
    azimuth = (2 if shown_field.name == CONTACT_PRESSURE else 1) * FRAMING.front
    plain = View(azimuth=azimuth, left=0.0, right=1.0, limit=1.0)
    low, high, limit, tallest = np.full(2, np.inf), np.full(2, -np.inf), shown_field.floor, 0.0
    for at in shown:
        skin = visible_skin(at, shown_field.read(at))
        least, greatest = frame([skin], obstacle_skin(at, extents), plain.eye)
        low, high = np.minimum(low, least), np.maximum(high, greatest)
        tallest = max(tallest, float(greatest[1] - least[1]))
        limit = max(limit, _upper(at, shown_field, skin))
    unit = COLUMN_UNITS[shown_field.unit]
    return View(
        azimuth=azimuth, left=float(low[0]), right=float(high[0]), height=float(high[1] - low[1]), width=width,
        limit=limit if limit > shown_field.floor else shown_field.floor + unit, color_by=color_by, extents=extents,
    )  # fmt: skip


def _upper(at: StateFields, shown: Field, skin: Skin) -> float:
    """Value that all but a hundredth of the volume, the contact area or the surface stay below."""
    if shown.name == CONTACT_PRESSURE:
        return _pressed(skin)
    if shown.name == VON_MISES:
        return at.von_mises_p99
    if shown.name == FIBER_TENSION:
        return maximum_tension(at)
    values = skin.values[skin.triangles].mean(axis=1)
    if shown.colors == DIVERGING:
        values = shown.floor + np.abs(values - shown.floor)
    return weighted_percentile(values, skin.areas)


def write_picture(
    path: str | Path,
    state: State | StateFields,
    view: View | None = None,
    *,
    title: str = "",
    ghost: State | StateFields | None = None,
    style: Style | None = None,
) -> None:
    """Draw a state of the whole actuator as `state_figure` does, and write it.

    Parameters
    ----------
    path : str or Path
        PNG file to write.
    state, view, title, ghost, style
        See `state_figure`.
    """
    check_ending(path, "picture")
    write_figure(path, state_figure(state, view, title=title, ghost=ghost, style=style), kind="picture")


def state_figure(
    state: State | StateFields,
    view: View | None = None,
    *,
    title: str = "",
    ghost: State | StateFields | None = None,
    style: Style | None = None,
) -> Figure:
    """Draw a state of the whole actuator at true scale, colored by von Mises stress or by contact pressure.

    Obstacles are drawn as translucent gray bodies.

    Parameters
    ----------
    state : State or StateFields
        What to draw; a half or quarter model is mirrored.
    view : View
        Direction, scale and colors; by default a view of this state and the ghost. A view made by
        ``shared_view(states, color_by="contact_pressure")`` gives a picture of the contact pressure.
    title : str
        Line above the actuator, see `picture_title`.
    ghost : State or StateFields
        State whose outline is drawn behind the actuator, usually the undeformed one.
    style : Style, optional
        Cut away, transparent, with the edges of cells.

    Returns
    -------
    matplotlib.figure.Figure
    """
    shown = [_fields(state)] if ghost is None else [_fields(state), _fields(ghost)]
    view = view or shared_view(shown)
    image = _rendered(shown, view, style or Style())
    colors = bar_of(view) if shows_values(shown[0], view) else None
    return framed(image, view, (title, view.field.note), colors)


def bare_picture(state: State | StateFields, view: View, style: Style | None = None) -> bytes:
    """Draw a state as `state_figure` does, but the actuator alone, without title, color bar and axes.

    Parameters
    ----------
    state : State or StateFields
        What to draw.
    view : View
        Direction, scale and colors, see `shared_view`.
    style : Style, optional

    Returns
    -------
    bytes
        A PNG file.
    """
    stream = BytesIO()
    imsave(stream, pixels_of(state, view, style=style), format="png")
    return stream.getvalue()


def pixels_of(
    state: State | StateFields, view: View, *, ghost: State | StateFields | None = None, style: Style | None = None
) -> NDArray[np.uint8]:
    """Draw the actuator alone as `bare_picture` does, and return its pixels, (h, w, 3).

    Parameters
    ----------
    state, view, ghost, style
        See `state_figure`.
    """
    shown = [_fields(state)] if ghost is None else [_fields(state), _fields(ghost)]
    return _rendered(shown, view, style or Style())


def shows_values(state: State | StateFields, view: View) -> bool:
    """Return whether a picture of a state has any color but that of rubber, and so needs a color bar."""
    at, shown = _fields(state), view.field
    if shown.name == FIBER_TENSION:
        return maximum_tension(at) > RENDERING.unseen * view.limit
    return float(np.abs(shown.read(at) - shown.floor).max()) > RENDERING.unseen * (view.limit - shown.floor)


def _rendered(shown: Sequence[StateFields], view: View, style: Style) -> NDArray[np.uint8]:
    """Image of the first of some states, with the outlines of the others."""
    at, shown_field = shown[0], view.field
    extents = view.extents or extents_of(shown)
    touching = shown_field.name == CONTACT_PRESSURE
    hollow = touching or shown_field.name == FIBER_TENSION
    skins = [visible_skin(at, np.zeros(len(at.points)) if hollow else shown_field.read(at))]
    skins += [visible_skin(each, np.zeros(len(each.points))) for each in shown[1:]]
    inside = None
    if style.transparent:
        walls = cavity_parts(at, skins[0])
        skins[0], inside = skins[0].part(~walls), skins[0].part(walls) if walls.any() else None
    if style.plane is not None:
        values = np.zeros(len(at.points)) if hollow else shown_field.read(at)
        rest = visible_skin(_at_rest(at), np.zeros(len(at.points))).points
        skins[0] = cut_away(at, skins[0], rest, style.plane, values)
    overlays = Overlays(
        threads=threads_with_tension(at),
        obstacles=obstacle_skin(at, extents),
        patches=pressed(contact_skin(at), view.limit, view.eye) if touching else (),
        inside=inside,
        edges=style.edges,
    )
    return render(skins, view, plain_rubber() if hollow else None, overlays)


def _at_rest(at: StateFields) -> StateFields:
    return StateFields(replace(at.state, displacement=np.zeros_like(at.displacement)), at.facts)


def picture_title(response: Response, row: int = -1, name: str = "") -> str:
    """Return the title of a picture from a row of the response: name, stage, pressure and bending angle if known.

    Examples
    --------
    >>> from turgor.foundation.response import Column
    >>> from turgor.foundation.source import Source
    >>> columns = (Column("pressure", "kPa", [0, 50e3]), Column("bending_angle", "deg", [0, 1.5]))
    >>> picture_title(Response(columns=columns, source=Source(text="a ruler")), name="finger")
    'finger · 50 kPa · bending angle 85.9°'
    >>> columns = (Column("bending_angle", "deg", [0, -1e-9]),)
    >>> picture_title(Response(columns=columns, source=Source(text="a ruler")))
    'bending angle 0.0°'
    """
    parts = [name] if name else []
    if response.stages and row not in (0, -len(response)):
        parts.append(response.stages[row])
    pressures = [f"{face_of(column)} {column.values[row] / kPa:.4g} kPa".strip() for column in pressures_in(response)]
    if pressures:
        parts.append(", ".join(pressures))
    elif "load_factor" in response.names:
        parts.append(f"load factor {response.column('load_factor')[row]:.4g}")
    if "bending_angle" in response.names:
        parts.append(f"bending angle {response.column('bending_angle')[row] / deg:z.1f}°")
    return " · ".join(parts)


def _fields(state: State | StateFields) -> StateFields:
    return state if isinstance(state, StateFields) else StateFields(state)


def _pressed(skin: Skin) -> float:
    """99th percentile of the contact pressure over the contact area; zero without contact."""
    values = skin.values[skin.triangles].mean(axis=1)
    on = values > 0
    return weighted_percentile(values[on], skin.areas[on]) if on.any() else 0.0
