"""Supplier: what the maker of a material states about it."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Supplier:
    """Statements of the maker of a material, to compare records with.

    Parameters
    ----------
    source : str
        Where it is stated.
    stress_at_stretch_2 : float or None [Pa]
        Nominal stress in uniaxial tension at stretch 2, called 100 % modulus by the trade.
    modulus : float or None [Pa]
        Young's modulus of a stiff part.
    mixing, cure : str
        How the parts are mixed and cured, in words; empty where that is not known or does not matter.
    doubts : tuple of str
        What is questionable about these numbers.
    """

    source: str
    stress_at_stretch_2: float | None = None
    modulus: float | None = None
    mixing: str = ""
    cure: str = ""
    doubts: tuple[str, ...] = ()
