"""Model of rods: rods between rigid plates, what holds the plates, loads and planes."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from turgor.core.model.loads import Gravity
from turgor.core.model.obstacles import Plane
from turgor.fast_models.rod.loads import ChamberPressure, LineLoad, PlateForce, RodLoad, Vector, vector
from turgor.fast_models.rod.sections.section import RodSection
from turgor.foundation.errors import TurgorError, unknown

#: What holds a plate: its free motions along x, y and z and about x, y and z, in its own axes.
FREE_MOTIONS: Mapping[str, tuple[bool, ...]] = MappingProxyType(
    {
        "free": (True,) * 6,
        "fixed": (False,) * 6,
        "pinned": (False, False, False, True, True, True),
        "hinge_x": (False, False, False, True, False, False),
        "hinge_y": (False, False, False, False, True, False),
        "hinge_z": (False, False, False, False, False, True),
    }
)

#: The plate that is fixed unless a model says otherwise.
BASE = "base"


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """Where a rod ends on a plate, or where a plate stands: a position and a rotation.

    Parameters
    ----------
    position : (3,) floats [m]
    turn : (3,) floats [rad]
        Axis of the rotation times its angle.

    Raises
    ------
    TurgorError
        If a vector does not have three finite numbers.

    Examples
    --------
    >>> Place(position=(0, 0.02, 0)).position
    (0.0, 0.02, 0.0)
    """

    position: Vector = (0.0, 0.0, 0.0)
    turn: Vector = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        for name in ("position", "turn"):
            object.__setattr__(self, name, vector(f"place: {name}", getattr(self, name)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Plate:
    """A rigid plate to which rods are clamped; rods that meet at a point share one without size.

    Parameters
    ----------
    name : str
    support : str
        One of `FREE_MOTIONS`: what holds the plate. A hinge turns about an axis of the plate.
    mass : float [kg]
    inertia : (3,) floats [kg m²]
        Moments of inertia about the axes of the plate.
    place : Place or None
        Where the plate stands at rest; None is where its first rod ends.

    Raises
    ------
    TurgorError
        If `support` is unknown, or a number is out of its range.

    Examples
    --------
    >>> Plate(name="tip", support="clamped")
    Traceback (most recent call last):
    turgor.TurgorError: unknown support of plate 'tip' 'clamped'. Known: fixed, free, hinge_x, ...
    """

    name: str
    support: str = "free"
    mass: float = 0.0
    inertia: Vector = (0.0, 0.0, 0.0)
    place: Place | None = None

    def __post_init__(self) -> None:
        support = self.support
        if support not in FREE_MOTIONS:
            raise unknown(f"support of plate '{self.name}'", support, FREE_MOTIONS)
        if not 0 <= self.mass < np.inf:
            raise TurgorError(f"plate '{self.name}': mass is {self.mass:g} kg; it must be 0 or more.")
        object.__setattr__(self, "inertia", vector(f"plate '{self.name}': inertia", self.inertia))
        if min(self.inertia) < 0:
            raise TurgorError(f"plate '{self.name}': inertia is {self.inertia} kg m²; each must be 0 or more.")


@dataclass(frozen=True, slots=True, kw_only=True)
class Rod:
    """A slender body between two plates; its axis leaves the first plate along x.

    Parameters
    ----------
    section : RodSection
    length : float [m]
        Without load.
    name : str
    elements : int
        Pieces that it is cut into; the error falls with the fourth power of their number.
    start, end : str
        Names of the plates that it joins.
    start_at, end_at : Place
        Where it leaves the first plate and arrives at the second, in the axes of each plate.
    rest_strain : (6,) floats [-, 1/m]
        Stretch − 1, shears, twist and curvatures at rest, such as those of a bent or helical rod.

    Raises
    ------
    TurgorError
        If a number is out of its range, or both ends are on one plate.

    Examples
    --------
    >>> Rod(section=RodSection.from_moduli(EA=1, GA=1, EI=1, GJ=1), length=0.0)
    Traceback (most recent call last):
    turgor.TurgorError: rod 'rod': length is 0 m; it must be more than 0.
    """

    section: RodSection
    length: float
    name: str = "rod"
    elements: int = 16
    start: str = BASE
    end: str = "tip"
    start_at: Place = field(default_factory=Place)
    end_at: Place = field(default_factory=Place)
    rest_strain: Sequence[float] = (0.0,) * 6

    def __post_init__(self) -> None:
        what = f"rod '{self.name}'"
        if not isinstance(self.section, RodSection):
            raise TurgorError(f"{what}: section is {self.section!r}; a RodSection is needed.")
        if not 0 < self.length < np.inf:
            raise TurgorError(f"{what}: length is {self.length:g} m; it must be more than 0.")
        if not (isinstance(self.elements, int) and 1 <= self.elements <= 10_000):
            raise TurgorError(f"{what}: elements is {self.elements}; a whole number from 1 to 10000 is needed.")
        if self.start == self.end:
            raise TurgorError(f"{what}: start and end are both '{self.start}'; a rod joins two plates.")
        rest = np.array(self.rest_strain, dtype=np.float64)
        if rest.shape != (6,) or not np.isfinite(rest).all() or not rest[0] > -1:
            raise TurgorError(f"{what}: rest_strain is {self.rest_strain}; six finite numbers are needed, first > -1.")
        object.__setattr__(self, "rest_strain", tuple(rest.tolist()))


@dataclass(frozen=True, slots=True, kw_only=True)
class RodModel:
    """Rods in series and in parallel, with supports, loads and planes.

    Rods in series end on one plate and start from it; rods in parallel share both plates. The plate ``"base"`` is
    fixed in the origin unless `plates` says otherwise; plates that `plates` does not name are free and have no mass.

    Parameters
    ----------
    rods : tuple of Rod
    loads : tuple of PlateForce, LineLoad, ChamberPressure and turgor.Gravity
    plates : tuple of Plate
    planes : tuple of turgor.obstacles.Plane
        Rigid planes that the rods touch without friction, at the contact radius of their sections.

    Raises
    ------
    TurgorError
        If names do not fit, no plate is fixed, or the weight of a rod is not known.

    Examples
    --------
    >>> rod = Rod(section=RodSection.from_moduli(EA=100, GA=30, EI=1e-3, GJ=1e-3), length=0.1)
    >>> RodModel(rods=[rod], loads=[PlateForce(plate="top", force=(0, 0, -1))])
    Traceback (most recent call last):
    turgor.TurgorError: unknown plate 'top'; did you mean 'tip'? Known: base, tip.
    """

    rods: Sequence[Rod]
    loads: Sequence[RodLoad] = ()
    plates: Sequence[Plate] = ()
    planes: Sequence[Plane] = ()

    def __post_init__(self) -> None:
        for name in ("rods", "loads", "plates", "planes"):
            object.__setattr__(self, name, tuple(getattr(self, name)))
        if not self.rods:
            raise TurgorError("rods: none is given; a model needs at least one.")
        _unique("rods", (rod.name for rod in self.rods))
        _unique("plates", (plate.name for plate in self.plates))
        known = self.plate_names
        for plate in self.plates:
            if plate.name not in known:
                raise unknown("plate", plate.name, known)
        if all(self.plate(name).support == "free" for name in known):
            way = "Plate(name=..., support='fixed')"
            raise TurgorError(f"no plate is fixed; fix one of {', '.join(known)} by {way}.")
        for load in self.loads:
            self._check(load)

    @property
    def plate_names(self) -> tuple[str, ...]:
        """Names of the plates in the order in which rods name them."""
        return tuple(dict.fromkeys(name for rod in self.rods for name in (rod.start, rod.end)))

    def plate(self, name: str) -> Plate:
        """Return a plate by its name, with what holds it."""
        for plate in self.plates:
            if plate.name == name:
                return plate
        if name not in self.plate_names:
            raise unknown("plate", name, self.plate_names)
        if name == BASE:
            return Plate(name=name, support="fixed", place=Place())
        return Plate(name=name)

    def rod(self, name: str) -> Rod:
        """Return a rod by its name; an unknown name fails with the near match."""
        for rod in self.rods:
            if rod.name == name:
                return rod
        raise unknown("rod", name, (rod.name for rod in self.rods))

    def _check(self, load: RodLoad) -> None:
        match load:
            case PlateForce():
                self.plate(load.plate)
            case LineLoad(rod=str() as name):
                self.rod(name)
            case ChamberPressure():
                rods = self.rods if load.rod is None else (self.rod(load.rod),)
                names = [chamber.name for rod in rods for chamber in rod.section.chambers]
                if not names:
                    raise TurgorError(
                        f"pressure in chamber '{load.chamber}': the sections have no chambers; give them a RodChamber, "
                        "or reinforced=True to RodSection.from_geometry."
                    )
                if load.chamber not in names:
                    raise unknown("chamber", load.chamber, set(names))
            case Gravity():
                self.check_mass("gravity")
            case LineLoad():
                pass
            case _:
                raise TurgorError(
                    f"load {load!r} is none of a rod; PlateForce, LineLoad, ChamberPressure or Gravity is needed."
                )

    def check_mass(self, what: str) -> None:
        """Raise a TurgorError where a section has no mass."""
        for rod in self.rods:
            if rod.section.mass_per_length is None:
                raise TurgorError(f"{what} needs the mass of rod '{rod.name}': its section has no mass_per_length.")


def _unique(what: str, names: Iterable[str]) -> None:
    every = list(names)
    if len(set(every)) < len(every):
        raise TurgorError(f"{what} are called {', '.join(every)}; every name must be unique.")
