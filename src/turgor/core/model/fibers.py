"""Fibers: threads wound on a face of the body or embedded in it, and how they run."""

from dataclasses import dataclass
from math import inf, isfinite, nan, pi
from numbers import Real

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import normalized
from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.material import Material
from turgor.core.model.embedded import EmbeddedThreads
from turgor.foundation.errors import TurgorError, unknown
from turgor.units import deg, mm

#: How fibers are modeled.
SMEARED, DISCRETE = "smeared", "discrete"

#: Which way a helix turns: a right-handed one turns like a screw that advances along the axis.
HANDS = ("right", "left", "both")


@dataclass(frozen=True, slots=True, kw_only=True)
class Winding:
    """How threads run around an axis: helices of one hand or both, hoops, or straight along the axis.

    The direction is given once: by its angle, whose name says from where it is counted, or by turns or pitch. How
    many threads there are is given by the distance between neighbors, measured across them, or by the number of
    threads that start at one end.

    Parameters
    ----------
    angle_from_axis : float [rad], optional
        Angle between thread and axis: 0 runs along it, 90° around it.
    angle_from_circumference : float [rad], optional
        Angle between thread and circumference, 90° less the other one.
    turns : float, optional
        Turns of each thread over the length of the face.
    pitch : float [m], optional
        Advance along the axis during one turn.
    spacing : float [m], optional
        Distance between neighboring threads, across them.
    starts : int, optional
        Threads that start at one end; 1 for a single thread.
    hand : str
        ``"right"``, ``"left"``, or ``"both"`` for a symmetric double winding.
    axis : (3,) floats
        Direction of the axis, from the fixed end to the tip.

    Raises
    ------
    TurgorError
        If the direction or the density is given twice or not at all, or a value cannot be.

    Examples
    --------
    >>> Winding(angle_from_axis=60 * deg, spacing=2 * mm).hand
    'right'
    >>> Winding(pitch=4 * mm, turns=10, starts=1)
    Traceback (most recent call last):
    turgor.TurgorError: a winding has turns and pitch; give exactly one of angle_from_axis, \
angle_from_circumference, turns, pitch.
    """

    angle_from_axis: float | None = None
    angle_from_circumference: float | None = None
    turns: float | None = None
    pitch: float | None = None
    spacing: float | None = None
    starts: int | None = None
    hand: str = "right"
    axis: tuple[float, float, float] = (1.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        if self.hand not in HANDS:
            raise unknown("hand of a winding", str(self.hand), HANDS)
        self._exactly_one(("angle_from_axis", "angle_from_circumference", "turns", "pitch"))
        self._exactly_one(("spacing", "starts"))
        for name in ("angle_from_axis", "angle_from_circumference"):
            angle = getattr(self, name)
            if angle is not None and not 0 <= _number(f"winding {name}", angle, "60*deg") <= pi / 2 + 1e-12:
                raise TurgorError(f"winding {name} is {angle / deg:g} deg; allowed is 0 deg to 90 deg.")
        for name, unit in (("turns", 1.0), ("pitch", mm), ("spacing", mm), ("starts", 1)):
            value = getattr(self, name)
            if value is not None and not 0 < _number(f"winding {name}", value, "2*mm" if unit == mm else "2") < inf:
                shown = f"{value / unit:g}" + (" mm" if unit == mm else "")
                raise TurgorError(f"winding {name} is {shown}; a positive value is needed.")
        if self.starts is not None and self.starts != int(self.starts):
            raise TurgorError(f"winding starts is {self.starts:g}; a whole number of threads is needed, at least 1.")
        axis = _vector(self.axis)
        if axis is None or not all(map(isfinite, axis)) or normalized((axis[0], axis[1], axis[2])) is None:
            raise TurgorError(f"winding axis is {self.axis!r}; a direction is needed, such as (1, 0, 0).")

    def _exactly_one(self, names: tuple[str, ...]) -> None:
        given = [name for name in names if getattr(self, name) is not None]
        if len(given) != 1:
            what = " and ".join(given) if given else "no direction" if len(names) > 2 else "no density"
            raise TurgorError(f"a winding has {what}; give exactly one of {', '.join(names)}.")


@dataclass(frozen=True, slots=True, kw_only=True)
class Fibers:
    """Threads on a face of the body, or inside it.

    Parameters
    ----------
    face : str or tuple of str
        Face that they are wound on, such as ``"outside"`` or ``"winding"``; several that go around together.
        Embedded threads have none.
    material : Material
        What they are made of; its law must be `Hooke`, of which the modulus counts.
    diameter : float [m]
        Diameter of a thread.
    winding : Winding or EmbeddedThreads
        How they run.
    form : str
        ``"smeared"``: their stiffness is spread over the face. ``"discrete"``: every thread is a chain of trusses
        tied to the face, wherever the mesh is.
    compression : float
        Share of the stiffness that works in compression: 0 for threads, which go slack, 1 for rods.
    bending : bool
        Whether threads resist a change of their curvature like a beam; discrete threads only.
    bending_diameter : float
        Diameter of that beam over the diameter of the thread. Half, as in the recipe of Xavier, Fleming and Yong 2021
        (section 8.1, references 81 and 139): a thread of many filaments bends more easily than a rod. In tension the
        full cross-section counts.
    within : two points (3,), optional [m]
        Lowest and highest corner of a box that threads do not leave, for windings that differ from side to side;
        corners may be infinite.
    name : str
        By which states before loading, such as a `PreStretch`, name the winding; by default its face, or ``"threads"``.

    Raises
    ------
    TurgorError
        If a value cannot be.
    """

    face: str | tuple[str, ...] = ()
    material: Material
    diameter: float
    winding: Winding | EmbeddedThreads
    form: str = SMEARED
    compression: float = 0.0
    bending: bool = False
    bending_diameter: float = 0.5
    within: tuple[tuple[float, float, float], tuple[float, float, float]] | None = None
    name: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.winding, Winding | EmbeddedThreads):
            raise TurgorError(
                f"fibers on '{self.face}': winding is {self.winding!r}; a Winding is needed, or EmbeddedThreads."
            )
        self._check_faces()
        if not isinstance(self.name, str):
            raise TurgorError(f"fibers on '{self.place}': name is {self.name!r}; a text is needed, such as 'hoops'.")
        object.__setattr__(self, "name", self.name or self.place or "threads")
        law = getattr(self.material, "law", None)
        if not isinstance(self.material, Material) or type(law) is not Hooke:
            raise TurgorError(
                f"fibers on '{self.place}': the law of '{getattr(self.material, 'name', self.material)}' is "
                f"{type(law).__name__}; fibers need a material with the law Hooke, of which Young's modulus counts."
            )
        if self.form not in (SMEARED, DISCRETE):
            raise unknown("form of fibers", str(self.form), (SMEARED, DISCRETE))
        self._check_numbers()
        if self.bending and self.form == SMEARED:
            raise TurgorError(f"fibers on '{self.place}': smeared fibers do not bend; bending needs form 'discrete'.")
        if self.within is not None:
            corners = [_vector(corner) for corner in self.within] if isinstance(self.within, tuple | list) else []
            if len(corners) != 2 or None in corners or not (np.array(corners[0]) < np.array(corners[1])).all():
                raise TurgorError(
                    f"fibers on '{self.place}': within is {self.within!r}; two corners are needed, the first below the "
                    "second one in every direction, such as ((0, -inf, -inf), (50*mm, inf, inf))."
                )

    def _check_faces(self) -> None:
        if isinstance(self.winding, EmbeddedThreads):
            self._check_embedded()
            return
        faces = (self.face,) if isinstance(self.face, str) else self.face
        if not isinstance(faces, tuple | list) or not faces or not all(isinstance(f, str) and f for f in faces):
            raise TurgorError(
                f"fiber face is {self.face!r}; the name of a face is needed, such as 'outside', or several names."
            )
        twice = sorted({face for face in faces if list(faces).count(face) > 1})
        if twice:
            raise TurgorError(f"fiber face is {self.face!r}; '{twice[0]}' stands there twice: name each face once.")

    def _check_embedded(self) -> None:
        """Refuse what only threads on a face have."""
        if self.face:
            raise TurgorError(f"fiber face is {self.face!r}, but embedded threads run through points; leave it out.")
        if self.form != DISCRETE or self.within is not None:
            what = "a box within" if self.form == DISCRETE else f"the form '{self.form}'"
            raise TurgorError(f"embedded threads have {what}; their form is '{DISCRETE}', and they have no box.")

    def _check_numbers(self) -> None:
        if not 0 < _number("fiber diameter", self.diameter, "0.2*mm") <= 10 * mm:
            raise TurgorError(f"fiber diameter is {self.diameter / mm:g} mm; allowed is more than 0 up to 10 mm.")
        pitch = self.winding.pitch if isinstance(self.winding, Winding) else None
        if pitch is not None and pitch < self.diameter:
            raise TurgorError(
                f"fiber pitch is {pitch / mm:.4g} mm, less than the diameter of {self.diameter / mm:.4g} mm; turns "
                "would overlap."
            )
        if not 0 <= _number("fiber compression", self.compression, "0") <= 1:
            raise TurgorError(f"fiber compression is {self.compression:g}; allowed is 0 (slack) to 1 (as in tension).")
        if not 0 < _number("bending_diameter of fibers", self.bending_diameter, "0.5") <= 1:
            raise TurgorError(
                f"fibers on '{self.place}': bending_diameter is {self.bending_diameter:g} of their diameter; "
                "allowed is more than 0 up to 1."
            )

    @property
    def faces(self) -> tuple[str, ...]:
        """Names of the faces that they are wound on."""
        return (self.face,) if isinstance(self.face, str) else tuple(self.face)

    @property
    def place(self) -> str:
        """The faces, as messages name them; of embedded threads their name."""
        return " and ".join(self.faces) or self.name

    @property
    def wound(self) -> Winding:
        """How they are wound on their face.

        Raises
        ------
        TurgorError
            If they are embedded.
        """
        if not isinstance(self.winding, Winding):
            raise TurgorError(f"fibers '{self.name}' run through points; a Winding on a face is needed here.")
        return self.winding

    @property
    def embedded(self) -> bool:
        """Whether they run inside the body instead of on a face."""
        return isinstance(self.winding, EmbeddedThreads)

    @property
    def box(self) -> str:
        """The box of the threads, as messages name it; empty where there is none."""
        if self.within is None:
            return ""
        low, high = (", ".join(f"{x * 1e3:.4g}" for x in corner) for corner in self.within)
        return f" within the box from ({low}) to ({high}) mm"

    def holds(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Whether points (..., 3) lie within the box of the threads."""
        if self.within is None:
            return np.ones(points.shape[:-1], dtype=bool)
        low, high = np.array(self.within)
        return np.asarray(((points >= low) & (points <= high)).all(axis=-1))

    @property
    def stretching_stiffness(self) -> float:
        """Young's modulus times cross-section of one thread [N]."""
        law = self.material.law
        assert isinstance(law, Hooke)
        return law.E * pi * self.diameter**2 / 4

    @property
    def bending_stiffness(self) -> float:
        """Young's modulus times second moment of area of one thread [N m²]; 0 where it bends freely."""
        law = self.material.law
        assert isinstance(law, Hooke)
        return law.E * pi * (self.bending_diameter * self.diameter) ** 4 / 64 if self.bending else 0.0


def _number(what: str, value: object, example: str) -> float:
    """Return a number, refusing anything else; NaN is within no range."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TurgorError(f"{what} is {value!r}; a number is needed, such as {example}.")
    return float(value)


def _vector(value: object) -> tuple[float, ...] | None:
    """Return three numbers as floats, or None for anything else; corners may be infinite."""
    try:
        numbers = tuple(nan if isinstance(v, str) else float(v) for v in value)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        return None
    return numbers if len(numbers) == 3 else None
