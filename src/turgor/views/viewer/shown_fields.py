"""Fields that the viewer shows: their names, units, values at the vertices, and the ends of their colors."""

from base64 import b64encode
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib
import numpy as np
from matplotlib.colors import Colormap, to_rgb
from numpy.typing import NDArray

from turgor.core.engine.percentiles import PERCENTILE
from turgor.core.results.fields.state_fields import StateFields
from turgor.units import kPa, mm
from turgor.views.pictures.colors import BOND_DAMAGE, CONTACT_PRESSURE, RUBBER, VON_MISES, color_map
from turgor.views.pictures.settings import LOOK
from turgor.views.viewer.inside import Inside
from turgor.views.viewer.packing import pack_steps
from turgor.views.viewer.surface import Surface

Array = NDArray[np.float64]

#: Colors of a color bar: as many as a color map of matplotlib has.
COLORS = int(matplotlib.rcParamsDefault["image.lut"])


@dataclass(frozen=True, slots=True, kw_only=True)
class ShownField:
    """A field that colors the surface.

    Parameters
    ----------
    key : str
        Its name in Python.
    label, unit : str
        Its name and unit on the color bar.
    scale : float
        Value of the unit in SI.
    of : callable or None
        Values of a state at the vertices of a surface, in SI. None for the displacement, which the page itself finds
        from the positions.
    """

    key: str
    label: str
    unit: str
    scale: float
    of: Callable[[StateFields, Surface | Inside], Array] | None


def _principal(at: StateFields, on: Surface | Inside) -> Array:
    return np.asarray(np.linalg.eigvalsh(on.pick(at.cauchy_stress))[:, 2])


#: The fields in the order of the menu; contact pressure and damage of bonds are left out where they are zero.
FIELDS = (
    ShownField(key=VON_MISES, label="von Mises stress", unit="kPa", scale=kPa, of=lambda at, on: on.pick(at.von_mises)),
    ShownField(
        key="stretch", label="largest principal stretch", unit="", scale=1.0, of=lambda at, on: on.pick(at.stretch)
    ),
    ShownField(key="principal_stress", label="largest principal Cauchy stress", unit="kPa", scale=kPa, of=_principal),
    ShownField(
        key=CONTACT_PRESSURE,
        label="contact pressure",
        unit="kPa",
        scale=kPa,
        of=lambda at, on: on.pick(at.contact_pressure),
    ),
    ShownField(key=BOND_DAMAGE, label="damage of bonds", unit="", scale=1.0, of=lambda at, on: on.pick(at.bond_damage)),
    ShownField(key="displacement", label="displacement", unit="mm", scale=mm, of=None),
)

#: What lies within the color bar, by the field.
NOTES = {
    VON_MISES: f"{PERCENTILE} % of the volume",
    CONTACT_PRESSURE: f"{PERCENTILE} % of the nodes in contact",
    BOND_DAMAGE: "all nodes",
    "principal_stress": f"{2 * PERCENTILE - 100} % of the nodes of the surface",
}


def shown_fields(states: Sequence[StateFields], surface: Surface, inside: Inside | None) -> list[dict[str, Any]]:
    """Put the fields of some states into the form that the viewer reads.

    Parameters
    ----------
    states : sequence of StateFields
        The steps of the viewer.
    surface : Surface
    inside : Inside or None
        What the face of a cut is made from.

    Returns
    -------
    list of dict
        For each field its words, the ends of its color bar in its unit, its colors and its packed values.
    """
    known = [(field, field.of) for field in FIELDS if field.of is not None]
    on: list[Surface | Inside] = [surface] if inside is None else [surface, inside]
    values: dict[str, list[list[Array]]] = {field.key: [[] for _ in on] for field, _ in known}
    most = dict.fromkeys((VON_MISES, "stretch"), 0.0)
    for at in states:
        at.settle()
        for field, of in known:
            for place, series in zip(on, values[field.key], strict=True):
                series.append(of(at, place) / field.scale)
        most[VON_MISES] = max(most[VON_MISES], at.von_mises_p99 / kPa)
        most["stretch"] = max(most["stretch"], at.stretch_p99)
    out = []
    for field, _ in known:
        every = [np.stack(series) for series in values[field.key]]
        if field.key in (CONTACT_PRESSURE, BOND_DAMAGE) and not every[0].any():
            continue
        out.append(_entry(field, _ends(field, every[0], most), every))
    farthest = max(float(np.linalg.norm(at.displacement, axis=1).max()) for at in states)
    return [*out, *(_entry(field, (0.0, farthest / field.scale), []) for field in FIELDS if field.of is None)]


def _entry(field: ShownField, ends: tuple[float, float], values: list[Array]) -> dict[str, Any]:
    """One field: its words, and its values on the surface and inside."""
    share = f"{NOTES.get(field.key, NOTES[VON_MISES])} lie within the bar"
    packed = [pack_steps(each[..., None]) for each in values]
    return {
        "key": field.key,
        "label": field.label,
        "unit": field.unit,
        "low": ends[0],
        "high": ends[1] if ends[1] > ends[0] else ends[0] + 1.0,
        "note": share if values else "",
        "colors": _colors(field.key),
        "data": packed[0] if packed else None,
        "inside": packed[1] if len(packed) > 1 else None,
    }


def _ends(field: ShownField, values: Array, most: dict[str, float]) -> tuple[float, float]:
    """Ends of the color bar over the whole path, in the unit of the field."""
    if field.key in most:
        return (1.0 if field.key == "stretch" else 0.0), most[field.key]
    if field.key == BOND_DAMAGE:
        return 0.0, 1.0
    if field.key == CONTACT_PRESSURE:
        return 0.0, float(np.percentile(values[values > 0], PERCENTILE))
    low, high = np.percentile(values, (100 - PERCENTILE, PERCENTILE))
    return float(low), float(high)


def _colors(key: str) -> str:
    """Colors of a field from its low to its high end, three bytes each, as text."""
    place = np.linspace(0, 1, COLORS)
    if key in (VON_MISES, CONTACT_PRESSURE):
        chosen: Colormap = color_map(key)
    else:
        chosen = matplotlib.colormaps["viridis" if key == "displacement" else "magma_r"]
        place = 0.05 + 0.75 * place if key != "displacement" else 0.1 + 0.85 * place
    colors = chosen(place)[:, :3]
    if key == CONTACT_PRESSURE:
        colors[: round(LOOK.faint_pressure * COLORS)] = to_rgb(RUBBER)
    return b64encode(np.rint(255 * colors).astype(np.uint8).tobytes()).decode()
