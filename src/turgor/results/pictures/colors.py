"""Colors of the fields that pictures show."""

from collections.abc import Mapping
from types import MappingProxyType

import matplotlib
import numpy as np
from matplotlib.colors import Colormap, LinearSegmentedColormap, ListedColormap, to_rgba

from turgor.errors import unknown

#: Color of the actuator where the field is zero.
RUBBER = "#f1efec"

VON_MISES, CONTACT_PRESSURE = "von_mises", "contact_pressure"

#: Label of the color bar, by the name of the field.
FIELDS: Mapping[str, str] = MappingProxyType(
    {
        VON_MISES: "von Mises stress [kPa]; {share} of the volume lie within the bar (arrow: more)",
        CONTACT_PRESSURE: "contact pressure [kPa]; {share} of the contact area lie within the bar (arrow: more)",
    }
)


def color_map(field: str) -> Colormap:
    """Return the color map of a field; its lightness changes evenly, so equal steps of the field look equal.

    The map of stress begins with the gray of rubber at rest and continues as Matplotlib's ``magma``. The map of contact
    pressure is ``viridis`` without its lightest end; it is drawn only where surfaces touch.

    Parameters
    ----------
    field : str
        ``"von_mises"`` or ``"contact_pressure"``.

    Examples
    --------
    >>> [round(float(c), 2) for c in color_map("von_mises")(0.0)[:3]]  # rubber
    [0.95, 0.94, 0.93]
    """
    if field not in FIELDS:
        raise unknown("field to color pictures by", field, FIELDS)
    place = np.linspace(0, 1, 256)
    if field == CONTACT_PRESSURE:
        return LinearSegmentedColormap.from_list("contact", matplotlib.colormaps["viridis_r"](0.08 + 0.92 * place))
    colors = matplotlib.colormaps["magma_r"](0.02 + 0.75 * place)
    share = np.clip(place / 0.3, 0, 1)[:, None]
    return LinearSegmentedColormap.from_list("stress", (1 - share) * to_rgba(RUBBER) + share * colors)


def plain_rubber() -> Colormap:
    """Return a color map that has the color of rubber at rest for every value."""
    return ListedColormap([RUBBER], name="rubber")
