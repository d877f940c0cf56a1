"""Chambers of a rod: what pressure in them does to force and strain."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PressureTable:
    """Strains that a pressure causes in a section that nothing else loads, from a section analysis or an experiment.

    Between the rows the table is linear; it must cover every requested pressure.

    Parameters
    ----------
    pressure : (m,) array [Pa]
        Rising, and 0 among them.
    strain : (m, 6) array [-, 1/m]
        Stretch − 1, shear in y and z, twist, curvature about y and z; zero at no pressure.
    stiffness : (m, 6, 6) array or None [N, N m, N m²]
        Tangent stiffness of the section at each pressure; None keeps that of the section.

    Raises
    ------
    TurgorError
        If shapes do not agree, the pressures do not rise, or 0 is not among them.

    Examples
    --------
    >>> strain = np.zeros((2, 6))
    >>> strain[1, 4] = -20.0  # 1/m at 50 kPa
    >>> print(PressureTable(pressure=[0, 50e3], strain=strain).strain_at(25e3))
    [  0.   0.   0.   0. -10.   0.]
    """

    pressure: ArrayLike
    strain: ArrayLike
    stiffness: ArrayLike | None = None

    def __post_init__(self) -> None:
        pressure, strain = (np.array(each, dtype=np.float64) for each in (self.pressure, self.strain))
        if pressure.ndim != 1 or len(pressure) < 2 or not (np.diff(pressure) > 0).all() or 0 not in pressure:
            raise TurgorError(f"table: pressure is {self.pressure!r}; two or more rising pressures with 0 are needed.")
        if strain.shape != (len(pressure), 6) or not np.isfinite(strain).all():
            raise TurgorError(f"table: strain has shape {strain.shape}; {len(pressure)} x 6 finite numbers are needed.")
        if strain[pressure == 0].any():
            raise TurgorError(
                f"table: strain at pressure 0 is {strain[pressure == 0][0].tolist()}; it must be zero, as a bent shape "
                "at rest is that of the rod."
            )
        object.__setattr__(self, "pressure", pressure)
        object.__setattr__(self, "strain", strain)
        if self.stiffness is not None:
            stiffness = np.array(self.stiffness, dtype=np.float64)
            if stiffness.shape != (len(pressure), 6, 6) or not np.isfinite(stiffness).all():
                raise TurgorError(
                    f"table: stiffness has shape {stiffness.shape}; {len(pressure)} x 6 x 6 finite numbers are needed."
                )
            object.__setattr__(self, "stiffness", stiffness)

    def __repr__(self) -> str:
        return brief(self)

    def strain_at(self, pressure: float) -> Array:
        """Return the strain at a pressure, (6,).

        Raises
        ------
        TurgorError
            If the table ends before.
        """
        return self._at(pressure, np.asarray(self.strain))

    def added_stiffness(self, pressure: float) -> Array:
        """Return by how much the stiffness at a pressure differs from that at none, (6, 6)."""
        if self.stiffness is None:
            return np.zeros((6, 6))
        stiffness = np.asarray(self.stiffness)
        return self._at(pressure, stiffness) - self._at(0.0, stiffness)

    def _at(self, pressure: float, values: Array) -> Array:
        known = np.asarray(self.pressure)
        if not known[0] <= pressure <= known[-1]:
            raise TurgorError(
                f"table: pressure is {pressure:g} Pa; the table holds {known[0]:g} to {known[-1]:g} Pa. Extend it."
            )
        place = min(int(np.searchsorted(known, pressure, side="right")), len(known) - 1)
        share = (pressure - known[place - 1]) / (known[place] - known[place - 1])
        return np.asarray((1 - share) * values[place - 1] + share * values[place])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RodChamber:
    """A chamber along a rod, closed at both ends of the rod.

    Its pressure acts by an area at an offset, as a force and a moment on the section: P A along the axis and P A times
    the offset. Where a table is given, the table says everything, and the area must be left out. Chambers act together
    by the sum of their strains.

    Parameters
    ----------
    name : str
    area : float [m²]
        Area of the cavity in the cross-section.
    offset : (2,) floats [m]
        Center of this area from the axis of the rod, in y and z.
    table : PressureTable or None

    Raises
    ------
    TurgorError
        If neither or both of area and table are given, or a number is out of its range.

    Examples
    --------
    >>> print(RodChamber(area=1e-5, offset=(0, 2e-3)).wrench_by_pressure)
    [1.e-05 0.e+00 0.e+00 0.e+00 2.e-08 0.e+00]
    """

    name: str = "cavity"
    area: float = 0.0
    offset: tuple[float, float] = (0.0, 0.0)
    table: PressureTable | None = None

    def __post_init__(self) -> None:
        offset = np.array(self.offset, dtype=np.float64)
        if offset.shape != (2,) or not np.isfinite(offset).all():
            raise TurgorError(f"chamber '{self.name}': offset is {self.offset}; two lengths [m], y and z, are needed.")
        if not 0 <= self.area < np.inf:
            raise TurgorError(f"chamber '{self.name}': area is {self.area:g} m²; it must be more than 0.")
        if (self.area > 0) == (self.table is not None):
            raise TurgorError(
                f"chamber '{self.name}': area is {self.area:g} m² and a table is "
                f"{'given' if self.table else 'not given'}; exactly one of them is needed."
            )

    @property
    def wrench_by_pressure(self) -> Array:
        """Force and moment on the section by a unit of pressure, (6,) [m², m³]; zero with a table."""
        y, z = self.offset
        return self.area * np.array([1.0, 0.0, 0.0, 0.0, z, -y])
