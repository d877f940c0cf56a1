"""Section of a rod: stiffness, mass, chambers, and what pressure does to its strains."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.material import UNSTATED, Material
from turgor.fast_models.rod.sections.chamber import RodChamber
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError
from turgor.foundation.source import Source

Array = NDArray[np.float64]

#: Strains of a rod in their order: along the axis x, across in y and z, about x, y and z.
STRAINS = ("stretch", "shear_y", "shear_z", "twist", "curvature_y", "curvature_z")

#: Places of stretch, twist and the two curvatures among the strains.
UNIFORM = (0, 3, 4, 5)


class Shape(Protocol):
    """Shape of a section for `RodSection.from_geometry`; `turgor.fast_models.rod.sections.shapes` has four."""

    @property
    def area(self) -> float: ...  # noqa: D102

    @property
    def second_moments(self) -> tuple[float, float]: ...  # noqa: D102

    @property
    def torsion_constant(self) -> float: ...  # noqa: D102

    @property
    def shear_factors(self) -> tuple[float, float]: ...  # noqa: D102

    @property
    def chambers(self) -> tuple[RodChamber, ...]: ...  # noqa: D102

    @property
    def contact_radius(self) -> float: ...  # noqa: D102


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RodSection:
    """Cross-section of a rod: its stiffness, mass and chambers.

    The axis of the rod is x. Strains are stretch − 1, shear in y and z, twist, curvature about y and about z [-, 1/m];
    forces are in the same order [N, N m].

    Parameters
    ----------
    stiffness : (6, 6) array [N, N m, N m²]
        Forces by strains, symmetric and positive definite.
    mass_per_length : float or None [kg/m]
        Needed for gravity and motion.
    rotary_inertia : (3,) floats or None [kg m]
        Mass per length times squared radius of gyration about x, y and z; None takes the radii of a section of one
        material, whose squares about y and z are bending stiffness over stiffness against stretch.
    chambers : tuple of RodChamber
        What pressure may act in.
    contact_radius : float [m]
        Distance from the axis to the outside, for contact.
    damping_time : float [s]
        Viscous forces are this time times stiffness times rate of strain (Kelvin–Voigt); 0 is none.
    source : Source
        Where the numbers came from.

    Raises
    ------
    TurgorError
        If a number is missing, not finite or out of its range.

    Examples
    --------
    >>> section = RodSection.from_moduli(EA=100.0, GA=30.0, EI=1e-3, GJ=7e-4)
    >>> section.stiffness.diagonal().tolist()
    [100.0, 30.0, 30.0, 0.0007, 0.001, 0.001]
    """

    stiffness: ArrayLike
    mass_per_length: float | None = None
    rotary_inertia: Sequence[float] | None = None
    chambers: tuple[RodChamber, ...] = ()
    contact_radius: float = 0.0
    damping_time: float = 0.0
    source: Source = field(default=UNSTATED)

    def __post_init__(self) -> None:
        object.__setattr__(self, "stiffness", checked_stiffness("section: stiffness", self.stiffness))
        if self.mass_per_length is not None and not 0 < self.mass_per_length < np.inf:
            raise TurgorError(f"section: mass_per_length is {self.mass_per_length:g} kg/m; it must be more than 0.")
        inertia = np.array(self._of_one_material() if self.rotary_inertia is None else self.rotary_inertia, dtype=float)
        if inertia.shape != (3,) or not (np.isfinite(inertia).all() and (inertia >= 0).all()):
            raise TurgorError(
                f"section: rotary_inertia is {self.rotary_inertia}; three numbers [kg m] of at least 0 are needed."
            )
        object.__setattr__(self, "rotary_inertia", tuple(inertia.tolist()))
        for name, unit in (("contact_radius", "m"), ("damping_time", "s")):
            if not 0 <= getattr(self, name) < np.inf:
                raise TurgorError(f"section: {name} is {getattr(self, name):g} {unit}; it must be 0 or more.")
        object.__setattr__(self, "chambers", tuple(self.chambers))
        names = [chamber.name for chamber in self.chambers]
        if len(set(names)) < len(names):
            raise TurgorError(f"section: chambers are called {', '.join(names)}; every name must be unique.")

    def __repr__(self) -> str:
        return brief(self)

    def _of_one_material(self) -> Array:
        diagonal = np.asarray(self.stiffness).diagonal()
        about_y, about_z = (self.mass_per_length or 0.0) * diagonal[4:] / diagonal[0]
        return np.array([about_y + about_z, about_y, about_z])

    @classmethod
    def from_moduli(
        cls, *, EA: float, GA: ArrayLike, EI: ArrayLike, GJ: float, mass_per_length: float | None = None
    ) -> "RodSection":
        """Make a section without coupling between its strains.

        Parameters
        ----------
        EA : float [N]
            Stiffness against stretch.
        GA : float or (2,) floats [N]
            Stiffness against shear in y and z.
        EI : float or (2,) floats [N m²]
            Stiffness against curvature about y and z.
        GJ : float [N m²]
            Stiffness against twist.
        mass_per_length : float or None [kg/m]

        Returns
        -------
        RodSection
        """
        shear, bending = (_pair(name, value) for name, value in (("GA", GA), ("EI", EI)))
        return cls(stiffness=np.diag([EA, *shear, GJ, *bending]), mass_per_length=mass_per_length)

    @classmethod
    def from_uniform(
        cls, stiffness: ArrayLike, shear: ArrayLike, *, mass_per_length: float | None = None
    ) -> "RodSection":
        """Make a section from its stiffness against uniform strains, as a section analysis gives it.

        Parameters
        ----------
        stiffness : (4, 4) array [N, N m, N m²]
            Forces by stretch, twist and curvatures about y and z.
        shear : float or (2,) floats [N]
            Stiffness against shear in y and z, which a section under uniform strains cannot tell.
        mass_per_length : float or None [kg/m]

        Returns
        -------
        RodSection
        """
        given = np.array(stiffness, dtype=np.float64)
        if given.shape != (4, 4):
            raise TurgorError(f"section: stiffness has shape {given.shape}; 4 x 4 numbers are needed here.")
        full = np.diag([0.0, *_pair("shear", shear), 0.0, 0.0, 0.0])
        full[np.ix_(UNIFORM, UNIFORM)] = given
        return cls(stiffness=full, mass_per_length=mass_per_length)

    @classmethod
    def from_geometry(
        cls, shape: Shape, material: Material, *, reinforced: bool = False, damping_time: float = 0.0
    ) -> "RodSection":
        """Make the section of a shape with the initial moduli of a material.

        The stiffness is that of small strains, and the axis passes through the center of the rubber's area. Pressure
        is a matter of the wall: one that fibers keep from bulging passes P times the area of the cavity on; one of bare
        incompressible rubber shortens by its hoop stress as much as the ends stretch it, so that the first strain is of
        the order of P². Bare walls therefore have no chamber here: give them a `RodChamber` with a table.

        Parameters
        ----------
        shape : one of `turgor.fast_models.rod.sections.shapes`
        material : Material
            Gives Young's and shear modulus, and the density.
        reinforced : bool
            Whether fibers keep the wall from bulging, so that the cavity becomes a chamber.
        damping_time : float [s]

        Returns
        -------
        RodSection

        Examples
        --------
        >>> from turgor.core.materials.laws.laws import NeoHooke
        >>> from turgor.fast_models.rod.sections.shapes import Round
        >>> rubber = Material(name="rubber", law=NeoHooke(C10=0.1e6), density=1000.0)
        >>> RodSection.from_geometry(Round(radius=5e-3), rubber).mass_per_length
        0.07853981633974483
        """
        young, shear_modulus = initial_moduli(material)
        about_y, about_z = shape.second_moments
        across_y, across_z = (shear_modulus * shape.area * factor for factor in shape.shear_factors)
        diagonal = [
            young * shape.area, across_y, across_z,
            shear_modulus * shape.torsion_constant, young * about_y, young * about_z,
        ]  # fmt: skip
        density = material.density
        polar = (about_y + about_z, about_y, about_z)
        return cls(
            stiffness=np.diag(diagonal),
            mass_per_length=None if density is None else density * shape.area,
            rotary_inertia=None if density is None else tuple(density * each for each in polar),
            chambers=shape.chambers if reinforced else (),
            contact_radius=shape.contact_radius,
            damping_time=damping_time,
            source=Source(text=f"{shape!r} of {material.name}, initial moduli"),
        )


def initial_moduli(material: Material) -> tuple[float, float]:
    """Return Young's modulus and the shear modulus of a material without strain [Pa].

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> initial_moduli(Material(name="rubber", law=NeoHooke(C10=0.1e6)))
    (600000.0, 200000.0)
    """
    if material.has_fibers:
        raise TurgorError(f"material '{material.name}' has directions, which a rod does not take yet.")
    if isinstance(material.law, Hooke):
        return material.law.E, material.law.shear_modulus
    shear = material.law.shear_modulus
    return (3 * shear if material.incompressible else 9 * shear / (3 + shear / material.bulk_modulus)), shear


def checked_stiffness(what: str, stiffness: ArrayLike) -> Array:
    """Return a stiffness as a read-only array (6, 6).

    Raises
    ------
    TurgorError
        If it is not symmetric and positive definite.
    """
    matrix = np.array(stiffness, dtype=np.float64)
    if matrix.shape != (6, 6) or not np.isfinite(matrix).all():
        raise TurgorError(f"{what} has shape {matrix.shape}; 6 x 6 finite numbers are needed, of {', '.join(STRAINS)}.")
    scale = np.sqrt(np.outer(np.abs(matrix.diagonal()), np.abs(matrix.diagonal())))
    if (uneven := np.abs(matrix - matrix.T) > 1e-9 * scale).any():
        i, j = np.argwhere(uneven)[0]
        raise TurgorError(
            f"{what} is not symmetric: [{i}, {j}] is {matrix[i, j]:g} and [{j}, {i}] {matrix[j, i]:g}; forces by "
            "strains must be."
        )
    scale = np.where(scale > 0, scale, 1.0)
    least = float(np.linalg.eigvalsh(matrix / scale).min())
    if not (matrix.diagonal() > 0).all() or least <= 0:
        raise TurgorError(
            f"{what} has the diagonal {matrix.diagonal().tolist()} and is not positive definite (its least eigenvalue "
            f"is {least:.3g} of the diagonal); every strain must need a force."
        )
    matrix.setflags(write=False)
    return matrix


def _pair(name: str, value: ArrayLike) -> list[float]:
    pair = np.array(value, dtype=np.float64)
    if pair.shape not in ((), (2,)):
        raise TurgorError(f"section: {name} is {value!r}; one number or two, for y and z, are needed.")
    return np.broadcast_to(pair, 2).tolist()
