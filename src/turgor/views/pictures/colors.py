"""Colors: the fields that pictures show, their units, ranges and color maps."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import matplotlib
import numpy as np
from matplotlib.colors import Colormap, LinearSegmentedColormap, ListedColormap, to_rgba
from numpy.typing import NDArray

from turgor.core.engine.percentiles import PERCENTILE
from turgor.core.results.fields.state_fields import StateFields
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import COLUMN_UNITS

Array = NDArray[np.float64]

#: Color of the actuator where the field is zero.
RUBBER = "#f1efec"

VON_MISES, CONTACT_PRESSURE, FIBER_TENSION = "von_mises", "contact_pressure", "fiber_tension"
#: Color by the damage of bonds between bodies.
BOND_DAMAGE = "bond_damage"

#: Color maps that a field may have: from rubber to dark, and from blue over rubber to red.
STRESS, DIVERGING = "stress", "diverging"


@dataclass(frozen=True, slots=True, kw_only=True)
class Field:
    """A field that a picture can show in colors.

    Parameters
    ----------
    name : str
        Its name, such as ``"hoop_stretch"``.
    label : str
        What stands at the color bar, without the unit.
    unit : str
        Unit that the color bar is in, one of those of `turgor.foundation.response.Column`; empty for a pure number.
    values : callable
        ``values(at) -> (n,) array [SI]`` at the nodes of the mesh, or (d,) at those of its regions, of a `StateFields`.
    floor : float [SI]
        Lower end of the colors.
    colors : str
        ``"stress"`` begins with the color of rubber and gets darker; ``"diverging"`` has rubber at ``floor``, red above
        it and blue as far below it.

    Examples
    --------
    >>> height = Field(name="height", label="height", unit="mm", values=lambda at: at.points[:, 2])
    >>> [round(float(part), 2) for part in height.color_map()(0.0)[:3]]  # rubber
    [0.95, 0.94, 0.93]
    """

    name: str
    label: str
    unit: str
    values: Callable[[StateFields], Array]
    floor: float = 0.0
    colors: str = STRESS

    def __post_init__(self) -> None:
        if self.unit not in COLUMN_UNITS:
            raise unknown(f"unit of the field '{self.name}'", self.unit, (each for each in COLUMN_UNITS if each))
        if self.colors not in (STRESS, DIVERGING):
            raise unknown(f"colors of the field '{self.name}'", self.colors, (STRESS, DIVERGING))

    def color_map(self) -> Colormap:
        """Return the color map; equal steps of the field look equal."""
        return _CONTACT if self.name == CONTACT_PRESSURE else _MAPS[self.colors]

    def read(self, at: StateFields) -> Array:
        """Return the values of a state, once for all pictures of it."""
        values = at.once(("field", self), lambda: np.asarray(self.values(at), dtype=np.float64))
        if values.shape not in ((len(at.mesh.points),), (len(at.facts.region_nodes.node),)):
            raise TurgorError(
                f"field '{self.name}' has values of the shape {values.shape}; one number for each of the "
                f"{len(at.mesh.points)} nodes is needed."
            )
        return values

    @property
    def note(self) -> str:
        """Meaning of the colors, next to the color bar."""
        unit = f" [{self.unit}]" if self.unit else ""
        share = f"{PERCENTILE} %"
        if self.name in (VON_MISES, CONTACT_PRESSURE):
            of = "volume" if self.name == VON_MISES else "contact area"
            return f"{self.label}{unit}; {share} of the {of} lie within the bar (arrow: more)"
        return f"{self.label}{unit}"


def principal_stress(at: StateFields) -> Array:
    """Largest principal Cauchy stress at the nodes of each region, (d,) [Pa]; tension is positive."""
    return np.asarray(np.linalg.eigvalsh(at.cauchy_stress)[:, -1])


def _displacement(at: StateFields) -> Array:
    return np.asarray(np.linalg.norm(at.displacement, axis=1))


def _nothing(at: StateFields) -> Array:
    return np.zeros(len(at.mesh.points))


_LISTED = (
    Field(name=VON_MISES, label="von Mises stress", unit="kPa", values=lambda at: at.von_mises),
    Field(name=CONTACT_PRESSURE, label="contact pressure", unit="kPa", values=lambda at: at.contact_pressure),
    Field(name="stretch", label="largest principal stretch", unit="", values=lambda at: at.stretch, floor=1.0),
    Field(
        name="principal_stress", label="largest principal Cauchy stress", unit="kPa", values=principal_stress,
        colors=DIVERGING,
    ),
    Field(
        name="mean_stress", label="mean stress (tension is positive)", unit="kPa", values=lambda at: at.mean_stress,
        colors=DIVERGING,
    ),
    Field(name=BOND_DAMAGE, label="damage of bonds (1 is open)", unit="", values=lambda at: at.bond_damage),
    Field(name="displacement", label="displacement", unit="mm", values=_displacement),
    Field(name=FIBER_TENSION, label="tension of a fiber", unit="N", values=_nothing),
)  # fmt: skip

#: Fields that pictures know by name.
FIELDS: Mapping[str, Field] = MappingProxyType({field.name: field for field in _LISTED})


def field_of(given: str | Field) -> Field:
    """Return a field, given itself or by its name.

    Examples
    --------
    >>> field_of("stretch").floor
    1.0
    >>> field_of("strech")
    Traceback (most recent call last):
    turgor.TurgorError: unknown field to color pictures by 'strech'; did you mean 'stretch'? ...
    """
    if isinstance(given, Field):
        return given
    if given not in FIELDS:
        raise unknown("field to color pictures by", given, FIELDS)
    return FIELDS[given]


def color_map(field: str | Field) -> Colormap:
    """Return the color map of a field; its lightness changes evenly, so equal steps of the field look equal.

    The map of stress begins with the gray of rubber at rest and continues as Matplotlib's ``magma``. The map of contact
    pressure is ``viridis`` without its lightest end; it is drawn only where surfaces touch.

    Parameters
    ----------
    field : str or Field
        Such as ``"von_mises"`` or ``"contact_pressure"``.

    Examples
    --------
    >>> [round(float(c), 2) for c in color_map("von_mises")(0.0)[:3]]  # rubber
    [0.95, 0.94, 0.93]
    """
    return field_of(field).color_map()


def plain_rubber() -> Colormap:
    """Return a color map that has the color of rubber at rest for every value."""
    return ListedColormap([RUBBER], name="rubber")


def _stress_map() -> Colormap:
    place = np.linspace(0, 1, 256)
    colors = matplotlib.colormaps["magma_r"](0.02 + 0.75 * place)
    share = np.clip(place / 0.3, 0, 1)[:, None]
    return LinearSegmentedColormap.from_list("stress", (1 - share) * to_rgba(RUBBER) + share * colors)


def _diverging_map() -> Colormap:
    names = ("#123a6f", "#2f78b5", "#8fbfdc", RUBBER, "#f0b48f", "#c8503f", "#6d0f22")
    return LinearSegmentedColormap.from_list("diverging", names)


_CONTACT = LinearSegmentedColormap.from_list(
    "contact", matplotlib.colormaps["viridis_r"](0.08 + 0.92 * np.linspace(0, 1, 256))
)
_MAPS = MappingProxyType({STRESS: _stress_map(), DIVERGING: _diverging_map()})
