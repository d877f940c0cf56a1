"""LayerStack: layers that jam under vacuum, how stiff they are loose and jammed, and where they slip.

Narang, Vlassak and Howe (Adv. Funct. Mater. 2018, 28, 1707136): n loose layers bend each about its own middle, jammed
ones as one beam of n² times the stiffness. The shear stress of the jammed beam is largest in its middle,
3 V / (2 b H) for the shear force V, and the layers slip where it reaches μ p.
"""

from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING

from turgor.core.materials.laws.energies.neo_hooke import NeoHooke
from turgor.core.model.loads.hardening import Hardening
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity, number


@dataclass(frozen=True, slots=True, kw_only=True)
class LayerStack:
    """A stack of equal layers in an airtight cover, which jams as the air is drawn out.

    Parameters
    ----------
    layers : int
        How many there are, at least 2.
    thickness : float [m]
        Of one layer.
    width : float [m]
    modulus : float [Pa]
        Young's modulus of a layer.
    pressure : float [Pa]
        By which the pressure in the cover is below that around, with its sign positive.
    friction : float
        Coefficient of friction between the layers.

    Raises
    ------
    TurgorError
        If a number is not allowed.

    Examples
    --------
    Twenty sheets of paper:

    >>> paper = LayerStack(
    ...     layers=20, thickness="0.1 mm", width="50 mm", modulus="6 GPa", pressure="70 kPa", friction=0.65
    ... )
    >>> round(paper.jammed_stiffness / paper.loose_stiffness), round(paper.slip_force, 2)
    (400, 3.03)
    >>> paper.hardening("core").factor
    399.0
    """

    layers: int
    thickness: float
    width: float
    modulus: float
    pressure: float
    friction: float

    if TYPE_CHECKING:

        def __init__(
            self, *, layers: int, thickness: Quantity, width: Quantity, modulus: Quantity, pressure: Quantity,
            friction: float,
        ) -> None: ...  # fmt: skip

    def __post_init__(self) -> None:
        dimensions = {"thickness": "length", "width": "length", "modulus": "pressure", "pressure": "pressure"}
        for key in (*dimensions, "friction"):
            value = number(getattr(self, key), f"layer stack: {key}", dimensions.get(key, ""))
            if not (value > 0 and isfinite(value)):
                raise TurgorError(f"layer stack: {key} is {value:g} in SI units; it must be above 0.")
            object.__setattr__(self, key, value)
        if not isinstance(self.layers, int) or not 2 <= self.layers <= 1000:
            raise TurgorError(f"layer stack: layers is {self.layers}; a whole number from 2 to 1000 is needed.")

    @property
    def height(self) -> float:
        """Thickness of the whole stack [m]."""
        return self.layers * self.thickness

    @property
    def loose_stiffness(self) -> float:
        """Bending stiffness E I of layers that slide [N m²]."""
        return self.layers * self.modulus * self.width * self.thickness**3 / 12

    @property
    def jammed_stiffness(self) -> float:
        """Bending stiffness E I of the stack as one beam, n² times as much [N m²]."""
        return self.modulus * self.width * self.height**3 / 12

    @property
    def slip_force(self) -> float:
        """Shear force at which the first layers slip [N], μ p over the largest shear stress per force at an interface.

        An odd number of layers has no interface in the middle.
        """
        at_interface = 1 - (self.layers % 2) / self.layers**2
        return self.friction * self.pressure * 2 * self.width * self.height / 3 / at_interface

    @property
    def law(self) -> NeoHooke:
        """Law of a solid body of the size of the stack that bends like its loose layers."""
        return NeoHooke(C10=self.modulus / self.layers**2 / 6)

    def hardening(self, body: str) -> Hardening:
        """Return the load of a stage that jams a body of this law in the shape that it has.

        Parameters
        ----------
        body : str

        Returns
        -------
        Hardening
        """
        return Hardening(body, float(self.layers**2 - 1))
