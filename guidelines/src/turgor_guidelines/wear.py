"""Wear: how long rubber lasts, from the energy that opens the cracks that are there at first."""

import turgor as tg
from turgor_guidelines.parts import elastosil

#: First flaws [m]; ratios of lives do not depend on it.
FLAW = 0.1e-3

#: Exponents of crack growth, of natural rubber and of a rubber that does not crystallize; silicones lie between.
EXPONENTS = (2.0, 4.0)

#: Beyond this ratio a number would say more than is known.
MANY = 1000


def tearing(stretch: float) -> float:
    """Tearing energy of a flaw [J/m²] where a wall of Elastosil M4601 is stretched one way, its width being constant.

    Examples
    --------
    >>> f"{tearing(1.5):.0f} J/m²"
    '40 J/m²'
    """
    rubber = elastosil().law
    shear_modulus = rubber.shear_modulus
    energy = shear_modulus / 2 * (stretch**2 + stretch**-2 - 2)
    return float(tg.laws.tearing_energy_of_crack(energy, stretch, FLAW))


def lives(spared: float, worn: float) -> str:
    """Say how many times as long a rubber lasts whose flaws tear with less energy: cycles go with T^−β.

    Examples
    --------
    >>> lives(10.0, 20.0)
    '4 to 16 times'
    """
    low, high = (worn / spared) ** EXPONENTS[0], (worn / spared) ** EXPONENTS[1]
    if low > MANY:
        return f"more than {MANY:,} times"
    return f"{_text(low)} to {_text(high)} times" if high < MANY else f"{_text(low)} to more than {MANY:,} times"


def _text(ratio: float) -> str:
    return f"{ratio:.0f}" if ratio > 10 else f"{ratio:.2g}"
