"""Bellows of revolution: a corrugated tube with end caps that extends along its axis."""

from dataclasses import dataclass
from math import pi

from turgor.core.geometry.extrusion import Layer, Sweep, Turned, end_names
from turgor.core.geometry.geometry import Geometry, check_volume
from turgor.core.geometry.parts.ends import name_faces
from turgor.core.geometry.parts.folds import Folds, bellows_profiles
from turgor.core.geometry.rules import SMALLEST_LENGTH, check_fields, check_length, in_mm
from turgor.core.geometry.shapes.revolved import HALF, QUARTER, WHOLE, revolved, revolved_volume
from turgor.core.geometry.shapes.sections import Outline
from turgor.core.geometry.shapes.solids import cut, face_names, region_names, volume
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class BellowsOfRevolution:
    """Bellows: a corrugated wall turned about the x axis, closed by a cap at each end.

    Pressure unfolds the corrugation, which bends the wall instead of stretching it, so the bellows extends far at a low
    pressure. All dimensions were chosen here, without a published drawing.

    Parameters
    ----------
    folds : int
        Number of folds, 1 to 50.
    inner_radius : float [m]
        Smallest radius of the cavity, where the folds meet.
    outer_radius : float [m]
        Largest radius of the outside, on the crests.
    wall : float [m]
        Thickness of the corrugated wall, measured across it.
    pitch : float [m]
        Length of one fold.
    cap : float [m]
        Thickness of the end caps, which are as wide as the wall where it meets them.
    fold_shape : str
        ``"rounded"``: flat rings joined by arcs; ``"straight"``: cones that meet in sharp edges.
    inlet_diameter : float [m]
        Diameter of the air inlet along the axis through the fixed cap; 0 leaves it out and closes the cavity.
    clamp_length : float [m]
        Length of a solid block before the first cap, fixed on all its sides; 0 leaves it out.
    symmetric : bool
        Whether to model only a part, cut at mirror planes.
    quarter : bool
        Whether that part is the quarter with y >= 0 and z >= 0 (loads without a side, such as pressure) or the half
        with y >= 0 (loads along z, such as gravity). Not used where ``symmetric`` is False.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> bellows = BellowsOfRevolution(folds=3)
    >>> round(bellows.length * 1e3, 6)  # mm: three folds of 10 mm and two caps of 4 mm
    38.0
    >>> BellowsOfRevolution(outer_radius=9e-3)
    Traceback (most recent call last):
    turgor.TurgorError: pitch is 10 mm; allowed is 0.1 mm to 1.96 mm, so that rounded folds fit between the \
radii 8 mm and 9 mm.
    """

    folds: int = 4
    inner_radius: float = 8 * mm
    outer_radius: float = 16 * mm
    wall: float = 1.5 * mm
    pitch: float = 10 * mm
    cap: float = 4 * mm
    fold_shape: str = "rounded"
    inlet_diameter: float = 0.0
    clamp_length: float = 0.0
    symmetric: bool = True
    quarter: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        folds = self._folds
        check_length("cap", self.cap, low=0.1 * mm, high=1 * m)
        if self.clamp_length:
            check_length("clamp_length", self.clamp_length, low=0.1 * mm, high=1 * m, why="0 leaves it out")
        if self.inlet_diameter:
            high = 2 * folds.inner_radius - SMALLEST_LENGTH
            why = f"less than the cavity, which is {in_mm(2 * folds.inner_radius)} wide at the cap; 0 leaves it out"
            check_length("inlet_diameter", self.inlet_diameter, low=0.1 * mm, high=high, why=why)

    @property
    def length(self) -> float:
        """Length of the bellows without a clamped block [m]: folds pitch + 2 cap."""
        return self._folds.length + 2 * self.cap

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m]."""
        return min(self.wall, self.cap)

    @property
    def cavity_volumes(self) -> dict[str, float]:
        """Volume of the cavity of the modeled part by the name of its face [m³], from the dimensions."""
        return {"cavity": revolved_volume(self._profiles()[1], self._turn)}

    @property
    def solid_volume(self) -> float:
        """Volume of the silicone of the modeled part [m³], from the dimensions."""
        return revolved_volume(self._profiles()[0], self._turn) - self.cavity_volumes["cavity"]

    def build(self) -> Geometry:
        """Build the solid and name it.

        Returns
        -------
        Geometry
            Region ``body``; faces ``cavity`` (with the duct of the inlet, where there is one), ``fixed`` (the plane
            x = 0 and the sides of the clamped block), ``tip`` (the other end), ``outside`` (the rest) and the mirror
            planes ``symmetry_y``, ``symmetry_z``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        outside, inside = self._profiles()
        cavity = revolved(inside, self._turn)
        cavity.faces.name = "cavity"
        check_volume("cavity", volume(cavity), self.cavity_volumes["cavity"])
        shape = cut(revolved(outside, self._turn), [cavity])
        shape.mat("body")
        check_volume("solid", volume(shape), self.solid_volume)
        mirrors = ("yz" if self.quarter else "y") if self.symmetric else ""
        name_faces(shape, end=self.clamp_length + self.length, clamp=self.clamp_length, mirrors=mirrors)
        part = (", quarter" if self.quarter else ", half") if self.symmetric else ""
        return Geometry(
            name=f"bellows of revolution, {self.folds} folds{part}",
            smallest_wall=self.smallest_wall,
            cavity_volumes=self.cavity_volumes,
            solid_volume=self.solid_volume,
            regions=region_names(shape),
            faces=face_names(shape),
            shape=shape,
            _sweep=self._sweep(mirrors),
        )

    def _sweep(self, mirrors: str) -> Sweep:
        """The same shape as one layer around the axis."""
        outside, inside = self._profiles()
        start = {"": -pi, "y": -pi / 2, "yz": 0.0}[mirrors]
        layer = Layer(start=start, end=start + self._turn, fill=(("body", outside), ("cavity", inside)))
        names = end_names(end=self.clamp_length + self.length, clamp=self.clamp_length, mirrors=mirrors)
        hinges = self._folds.hinges(self.clamp_length + self.cap)
        return Sweep(layers=(layer,), path=Turned(), names=names, hinges=hinges)

    @property
    def _folds(self) -> Folds:
        return Folds(
            count=self.folds,
            inner_radius=self.inner_radius,
            outer_radius=self.outer_radius,
            wall=self.wall,
            pitch=self.pitch,
            shape=self.fold_shape,
        )

    @property
    def _turn(self) -> float:
        if not self.symmetric:
            return WHOLE
        return QUARTER if self.quarter else HALF

    def _profiles(self) -> tuple[Outline, Outline]:
        """Profiles of the whole bellows, filled, and of its cavity."""
        return bellows_profiles(self._folds, cap=self.cap, clamp=self.clamp_length, inlet=self.inlet_diameter)
