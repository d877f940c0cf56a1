"""Sweeps: planar sections moved along a line or turned about an axis, for meshes of hexahedra."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import pi

import numpy as np

from turgor.core.geometry.shapes.sections import Outline, Point
from turgor.core.geometry.shapes.tolerances import TOLERANCE

#: Name of an area of a section: a region, a cavity (it begins with ``cavity``), or air around the solids. Air is None
#: if rules name its walls by their position, and ``"outside"`` if its walls always belong to that face, as in a bore.
Fill = tuple[str | None, Outline]


@dataclass(frozen=True, slots=True, kw_only=True)
class Layer:
    """Part of a sweep with a constant section.

    Parameters
    ----------
    start, end : float [m or rad]
        Range along the path: lengths for `Along`, angles for `Turned`.
    fill : tuple of (name, Outline)
        Areas of the section; later ones cover earlier ones, like coats of paint. The name is that of a region,
        that of a cavity (it begins with ``cavity``), None or ``"outside"`` for air.
    """

    start: float
    end: float
    fill: tuple[Fill, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Along:
    """Straight path along an axis.

    Parameters
    ----------
    axis : int
        Along x (0), y (1) or z (2). The section holds the two other coordinates in their order: (y, z), (x, z) or
        (x, y).
    """

    axis: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Turned:
    """Circular path about the x axis: the section holds (x, r), and the angle counts from +y towards +z.

    Layers run over the angle: −π/2 to π/2 is the half with y >= 0, 0 to π/2 the quarter with z >= 0 too.
    """


@dataclass(frozen=True, slots=True, kw_only=True)
class PlaneName:
    """Rule that names the outer surface in a plane, and the interface between two regions there.

    Parameters
    ----------
    name : str
        Name of the face.
    axis : int
        Coordinate that is constant in the plane.
    position : float [m]
        Value of the coordinate.
    within : bool
        Whether the face also goes through the inside of a region, as a layer within it.
    """

    name: str
    axis: int
    position: float
    within: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class RangeName:
    """Rule that names the outer surface between two planes, such as the sides of a clamped block.

    Parameters
    ----------
    name : str
        Name of the face.
    axis : int
        Coordinate that is limited.
    low, high : float [m]
        Range of the coordinate.
    ends : bool
        Whether the surface in the two planes themselves belongs to it.
    """

    name: str
    axis: int
    low: float
    high: float
    ends: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Interface:
    """Rule that names the surface between two regions at any position, such as a curved layer.

    Parameters
    ----------
    name : str
        Name of the face.
    regions : (2,) tuple of str
        The regions on its two sides; the face points out of the first.
    """

    name: str
    regions: tuple[str, str]


#: A rule that names faces.
FaceName = PlaneName | RangeName | Interface


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """The same shape as the CAD solids of a geometry, described as layers along a path.

    The surface between a region and a cavity is the face of that cavity. The other surface gets the name of the last
    rule that fits, and ``outside`` without one.

    Parameters
    ----------
    layers : tuple of Layer
        Layers in the order of the path, without gaps.
    path : Along or Turned
        Path of the section.
    names : tuple of PlaneName, RangeName or Interface
        Names of the faces other than cavities and ``outside``; later ones win.
    hinges : tuple of (2,) floats [m]
        Re-entrant corners of the section about which thin walls fold; cells are short there.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.sections import disc
    >>> tube = (("body", disc(6e-3)), ("cavity", disc(5e-3)))
    >>> closed = Sweep(layers=(Layer(start=0.0, end=2e-3, fill=tube[:1]), Layer(start=2e-3, end=40e-3, fill=tube)))
    >>> closed.outlines == (disc(6e-3), disc(5e-3))
    True
    """

    layers: tuple[Layer, ...]
    path: Along | Turned = Along()
    names: tuple[FaceName, ...] = ()
    hinges: tuple[Point, ...] = ()

    @property
    def is_closed(self) -> bool:
        """Whether the path is a full turn."""
        turn = self.layers[-1].end - self.layers[0].start
        return isinstance(self.path, Turned) and abs(turn - 2 * pi) < 1e-9

    @property
    def outlines(self) -> tuple[Outline, ...]:
        """All outlines of all layers, each once."""
        return tuple(dict.fromkeys(outline for layer in self.layers for _, outline in layer.fill))


#: A piece of a sweep: name, outline, and range along the path.
Part = tuple[str | None, Outline, tuple[float, float]]


def layers_of(parts: Sequence[Part]) -> tuple[Layer, ...]:
    """Divide parts into layers at all of their ends; later parts cover earlier ones.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.sections import disc
    >>> layers = layers_of([("body", disc(6e-3), (0.0, 40e-3)), ("cavity", disc(5e-3), (2e-3, 38e-3))])
    >>> [(layer.start, layer.end, len(layer.fill)) for layer in layers]
    [(0.0, 0.002, 1), (0.002, 0.038, 2), (0.038, 0.04, 1)]
    """
    ends = np.unique([end for _, _, along in parts for end in along])
    ends = ends[np.diff(ends, prepend=-np.inf) > TOLERANCE.round_off * np.ptp(ends)]
    layers = []
    for start, end in pairwise(ends.tolist()):
        middle = (start + end) / 2
        fill = tuple((name, outline) for name, outline, (low, high) in parts if low < middle < high)
        layers.append(Layer(start=start, end=end, fill=fill))
    return tuple(layers)


def end_names(*, end: float, clamp: float = 0.0, mirrors: str = "") -> tuple[FaceName, ...]:
    """Return the rules for the faces that every family has.

    Parameters
    ----------
    end : float [m]
        Position of the plane ``tip``; ``fixed`` is the plane x = 0.
    clamp : float [m]
        Length of the clamped block, whose sides belong to ``fixed``.
    mirrors : str
        Mirror planes that cut the modeled part: ``""``, ``"y"`` or ``"yz"``.

    Examples
    --------
    >>> [rule.name for rule in end_names(end=0.1, mirrors="y")]
    ['fixed', 'tip', 'symmetry_y']
    """
    names: list[FaceName] = [RangeName(name="fixed", axis=0, low=0.0, high=clamp)] if clamp else []
    names.append(PlaneName(name="fixed", axis=0, position=0.0))
    names.append(PlaneName(name="tip", axis=0, position=end))
    names += [PlaneName(name=f"symmetry_{m}", axis=1 + "yz".index(m), position=0.0) for m in mirrors]
    return tuple(names)
