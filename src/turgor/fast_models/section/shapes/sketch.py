"""Sketch: a cross-section as outlines of regions and cavities."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import combinations

from turgor.core.geometry.extrusion import FaceName, Interface, Layer, PlaneName, Sweep
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.names import INTERFACE
from turgor.core.geometry.shapes.sections import Outline
from turgor.foundation.display import Shown, listed
from turgor.foundation.errors import TurgorError, unknown


@dataclass(frozen=True, slots=True, kw_only=True)
class Sketch(Shown):
    """Outlines of regions and cavities in the plane across the actuator, painted one over the other.

    Parameters
    ----------
    areas : mapping of str to Outline or sequence of Outlines [m]
        What lies within each outline, as (y, z); later ones cover earlier ones. A name that begins with ``cavity`` is
        a cavity, ``"outside"`` is air without pressure, any other name a region.
    lines : mapping of str to (axis, position [m])
        Names of straight parts of the outer boundary or of the border between two regions, such as
        ``{"strain_limiting_layer": ("z", 0.0)}``.
    mirrors : str
        Mirror planes that cut the sketch: ``""``, ``"y"`` for a half with y >= 0, ``"yz"`` for a quarter.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.sections import disc
    >>> Sketch(areas={"body": disc(8e-3), "cavity": disc(6e-3)})
    Sketch(body, cavity)
    """

    areas: Mapping[str, Outline | tuple[Outline, ...]]
    lines: Mapping[str, tuple[str, float]] = field(default_factory=dict)
    mirrors: str = ""

    def __post_init__(self) -> None:
        if not any(self._is_region(name) for name in self.areas):
            raise TurgorError(f"a sketch needs a region; its areas are {listed(self.areas) or 'none'}.")
        for name, (axis, _) in self.lines.items():
            if axis not in ("y", "z"):
                raise unknown(f"axis of the line '{name}'", str(axis), ("y", "z"))
        if self.mirrors not in ("", "y", "z", "yz"):
            raise unknown("mirror planes", self.mirrors, ("", "y", "z", "yz"))

    def __repr__(self) -> str:
        return f"Sketch({listed(self.areas)})"

    @staticmethod
    def _is_region(name: str) -> bool:
        return name != "outside" and not name.startswith("cavity")

    @property
    def geometry(self) -> Geometry:
        """The sketch as a geometry of no length, with one layer of a sweep."""
        parts = [
            (name, outline)
            for name, given in self.areas.items()
            for outline in (given if isinstance(given, tuple) else (given,))
        ]
        regions = tuple(dict.fromkeys(name for name, _ in parts if self._is_region(name)))
        names: list[FaceName] = [Interface(name=INTERFACE, regions=pair) for pair in combinations(regions, 2)]
        names += [PlaneName(name=name, axis="xyz".index(a), position=at) for name, (a, at) in self.lines.items()]
        names += [PlaneName(name=f"symmetry_{m}", axis="xyz".index(m), position=0.0) for m in self.mirrors]
        size = min(abs(outline.area) ** 0.5 for _, outline in parts)
        sweep = Sweep(layers=(Layer(start=0.0, end=size, fill=tuple(parts)),), names=tuple(names))
        return Geometry(
            name="section",
            smallest_wall=size,
            cavity_volumes={},
            solid_volume=0.0,
            regions=regions,
            faces=(),
            shape=None,
            _sweep=sweep,
        )
