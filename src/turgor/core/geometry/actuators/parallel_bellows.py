"""Parallel bellows: three bellows that form an equilateral triangle between two plates."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi, sqrt
from typing import Any

from turgor.core.geometry import occ
from turgor.core.geometry.actuators.three_extenders import triangle_corner
from turgor.core.geometry.geometry import Geometry, check_volume
from turgor.core.geometry.parts.chambers import arrangement
from turgor.core.geometry.parts.ends import name_faces
from turgor.core.geometry.parts.folds import Folds, Necks, bellows_profiles
from turgor.core.geometry.rules import (
    MOST_FOLDS,
    MOST_RIBS,
    SMALLEST_LENGTH,
    check_count,
    check_fields,
    check_length,
    in_mm,
)
from turgor.core.geometry.shapes.revolved import HALF, WHOLE, revolved, revolved_volume
from turgor.core.geometry.shapes.sections import Outline, disc, prism
from turgor.core.geometry.shapes.solids import cut, face_names, region_names, volume
from turgor.foundation.errors import TurgorError
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class ParallelBellows:
    """Three parallel bellows between two plates, in an equilateral triangle (Xavier et al. 2021, fig. 1g).

    The bellows under pressure gets longer and tilts the upper plate away from it; equal pressures push the plate
    straight on. All dimensions were chosen here, without a published drawing.

    Constrained parallel bellows bend more than unconstrained ones (Xavier, Fleming and Yong 2021, section 7.3,
    guideline 4, after Drotman et al. 2019). The paper does not say what constrains them. Ribs were chosen here: plates
    between the two end plates that hold the three bellows together at their necks, so that they bend as one and none
    bows out. With ``constrained=False`` the necks are bare tubes, so that both kinds have the same folds and the same
    length. In a longer actuator (eight folds, three ribs) the ribs reduce the bending a little at equal pressure, but
    they keep a bellows from bowing out at a pressure at which it does so without them.

    Axes: x from the lower plate (the fixed end) to the upper one (the tip). The first bellows lies at +z, the others
    follow counterclockwise seen from the tip.

    Parameters
    ----------
    folds : int
        Number of folds of a bellows, a multiple of ``ribs`` + 1, up to 50.
    inner_radius : float [m]
        Smallest radius of the cavities, where the folds meet.
    outer_radius : float [m]
        Largest radius of the outside, on the crests.
    wall : float [m]
        Thickness of the corrugated wall, measured across it.
    pitch : float [m]
        Length of one fold.
    fold_shape : str
        ``"straight"``: cones that meet in sharp edges; ``"rounded"``: flat rings joined by arcs.
    cap : float [m]
        Thickness of the caps of a bellows, which are of its silicone.
    side : float [m]
        Distance between the axes of two bellows: the side of the triangle.
    ribs : int
        Number of necks, 0 to 9, and of ribs where the bellows are constrained.
    rib_thickness : float [m]
        Length of a neck and thickness of a rib. Not used without ribs.
    constrained : bool
        Whether the ribs are there.
    plate_thickness : float [m]
        Thickness of both end plates. They and the ribs are round.
    plate_margin : float [m]
        How far plates and ribs reach beyond the bellows.
    inlet_diameter : float [m]
        Diameter of the air inlet of each bellows through the lower plate; 0 leaves the inlets out.
    symmetric : bool
        Whether to model only the half with y >= 0, cut at the face ``symmetry_y``. It holds where the second and the
        third bellows share one pressure: they are then one face, ``cavity_2``.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> bellows = ParallelBellows(constrained=True)
    >>> round(bellows.length * 1e3, 6)  # mm: four folds of 7 mm, a neck of 2 mm, caps and plates of 3 mm
    42.0
    >>> ParallelBellows(folds=3)
    Traceback (most recent call last):
    turgor.TurgorError: folds is 3; allowed is a multiple of 2 up to 50, so that 1 neck divides them evenly.
    """

    folds: int = 4
    inner_radius: float = 5 * mm
    outer_radius: float = 10 * mm
    wall: float = 1.2 * mm
    pitch: float = 7 * mm
    fold_shape: str = "straight"
    cap: float = 3 * mm
    side: float = 24 * mm
    ribs: int = 1
    rib_thickness: float = 2 * mm
    constrained: bool = False
    plate_thickness: float = 3 * mm
    plate_margin: float = 2 * mm
    inlet_diameter: float = 0.0
    symmetric: bool = False

    def __post_init__(self) -> None:
        check_fields(self)
        least = SMALLEST_LENGTH
        check_count("ribs", self.ribs, low=0, high=MOST_RIBS)
        check_count("folds", self.folds, low=1, high=MOST_FOLDS)
        groups = self.ribs + 1
        if self.folds % groups:
            necks = "1 neck divides" if self.ribs == 1 else f"{self.ribs} necks divide"
            raise TurgorError(
                f"folds is {self.folds}; allowed is a multiple of {groups} up to {MOST_FOLDS // groups * groups}, "
                f"so that {necks} them evenly."
            )
        folds = self._folds
        width = 2 * folds.outer_radius
        why = f"so that bellows of {in_mm(width)} stay apart"
        check_length("side", self.side, low=width + least, high=2 * m, why=why)
        for name in ("cap", "plate_thickness", "plate_margin", *(["rib_thickness"] if self.ribs else [])):
            check_length(name, getattr(self, name), low=0.1 * mm, high=0.5 * m)
        if self.inlet_diameter:
            why = "less than the cavity; 0 leaves it out"
            check_length("inlet_diameter", self.inlet_diameter, high=2 * (self.inner_radius - least), why=why)

    @property
    def length(self) -> float:
        """Length over all [m]: folds, necks, caps and plates."""
        return self.folds * self.pitch + self._necks.count * self._necks.length + 2 * (self.cap + self.plate_thickness)

    @property
    def plate_radius(self) -> float:
        """Radius of plates and ribs [m]: side / √3 + outer_radius + plate_margin."""
        return self.side / sqrt(3) + self.outer_radius + self.plate_margin

    @property
    def smallest_wall(self) -> float:
        """Thickness of the thinnest wall [m], plates and ribs included."""
        rib = [self.rib_thickness] if self.ribs and self.constrained else []
        return min(self.wall, self.cap, self.plate_thickness, *rib)

    @property
    def cavity_volumes(self) -> Mapping[str, float]:
        """Volume of each cavity of the modeled part by the name of its face [m³], from the dimensions."""
        duct = pi / 4 * self.inlet_diameter**2 * self.plate_thickness
        volumes = {}
        for name, _, on_mirror in self._places:
            turn = HALF if on_mirror else WHOLE
            volumes[name] = revolved_volume(self._profiles[1], turn) + duct * turn / WHOLE
        return volumes

    @property
    def solid_volume(self) -> float:
        """Volume of silicone, plates and ribs of the modeled part [m³], from the dimensions."""
        part = 0.5 if self.symmetric else 1.0
        body = 3 * part * revolved_volume(self._profiles[0])
        plates = 2 * pi * self.plate_radius**2 * self.plate_thickness
        rib = pi * (self.plate_radius**2 - 3 * self._folds.neck_radius**2) * self._necks.length
        ribs = self._necks.count * rib if self.constrained else 0.0
        return body + part * (plates + ribs) - sum(self.cavity_volumes.values())

    def build(self) -> Geometry:
        """Build the solids and name them.

        Returns
        -------
        Geometry
            Regions ``body`` (the bellows) and ``plate`` (plates and ribs); faces ``cavity_1`` to ``cavity_3``,
            ``fixed`` (the plane x = 0), ``tip`` (the far side of the upper plate), ``interface`` (between bellows
            and plates), ``outside`` (the rest) and, for a half, ``symmetry_y``.

        Raises
        ------
        TurgorError
            If the CAD volumes are not those of the dimensions.
        """
        volumes, (outside, inside) = self.cavity_volumes, self._profiles
        bodies, ducts = [], []
        for name, number, on_mirror in self._places:
            turn, center = HALF if on_mirror else WHOLE, triangle_corner(self.side, number)
            cavity = revolved(inside, turn, center)
            if self.inlet_diameter:
                duct = prism(self._part(disc(self.inlet_diameter / 2, center)), (0.0, self.plate_thickness))
                duct.faces.name = name
                ducts.append(duct)
            cavity.faces.name = name
            air = volume(cavity) + (volume(ducts[-1]) if ducts else 0.0)
            check_volume(name, air, volumes[name])
            bodies.append(cut(revolved(outside, turn, center), [cavity]))
        plates = [cut(plate, ducts) for plate in self._plates()]
        for solids, region in ((bodies, "body"), (plates, "plate")):
            for solid in solids:
                solid.mat(region)
        shape = occ.Glue([*bodies, *plates])
        check_volume("solid", volume(shape), self.solid_volume)
        name_faces(shape, end=self.length, mirrors="y" if self.symmetric else "")
        kind = "constrained" if self.constrained and self.ribs else "unconstrained"
        return Geometry(
            name=f"three parallel bellows, {kind}{', half' if self.symmetric else ''}",
            smallest_wall=self.smallest_wall,
            cavity_volumes=volumes,
            solid_volume=self.solid_volume,
            regions=region_names(shape),
            faces=face_names(shape),
            shape=shape,
        )

    @property
    def _places(self) -> list[tuple[str, int, bool]]:
        return arrangement(3, self.symmetric)

    @property
    def _folds(self) -> Folds:
        """The folds between two necks."""
        return Folds(
            count=self.folds // (self.ribs + 1),
            inner_radius=self.inner_radius,
            outer_radius=self.outer_radius,
            wall=self.wall,
            pitch=self.pitch,
            shape=self.fold_shape,
        )

    @property
    def _necks(self) -> Necks:
        return Necks(count=self.ribs, length=self.rib_thickness if self.ribs else 0.0)

    @property
    def _profiles(self) -> tuple[Outline, Outline]:
        """Profiles of one bellows, filled, and of its cavity."""
        start = self.plate_thickness
        return bellows_profiles(self._folds, start=start, cap=self.cap, inlet=self.inlet_diameter, necks=self._necks)

    def _part(self, outline: Outline) -> Outline:
        return outline.cut_y() if self.symmetric else outline

    def _plates(self) -> list[Any]:
        """The two plates and, where they are, the ribs with their holes."""
        plate, end = self._part(disc(self.plate_radius)), self.length
        solids = [prism(plate, along) for along in ((0.0, self.plate_thickness), (end - self.plate_thickness, end))]
        if not self.constrained:
            return solids
        neck, length = self._folds.neck_radius, self._folds.length
        for i in range(self.ribs):
            start = self.plate_thickness + self.cap + length + i * (length + self.rib_thickness)
            along = (start, start + self.rib_thickness)
            holes = [disc(neck, triangle_corner(self.side, number)) for _, number, _ in self._places]
            solids.append(cut(prism(plate, along), [prism(self._part(hole), along) for hole in holes]))
        return solids
