"""Modeled: the share of a CAD part that is modeled, with the names of its faces."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from turgor.core.geometry.cad.part import Part
from turgor.core.geometry.wedge import Wedge
from turgor.foundation.finding import Finding


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Modeled:
    """The share of a part that is modeled.

    Parameters
    ----------
    part : Part
    names : tuple of str
        Names of its faces; those on mirror planes are ``symmetry_x`` and so on, those in the cuts of a wedge
        ``cyclic_low`` and ``cyclic_high``.
    findings : tuple of Finding
        What is used, and what is not (D07).
    wedge : Wedge, optional
        The sector that it is.
    renamed : mapping of str to str
        Cavities that have another name than in the whole part.
    """

    part: Part
    names: tuple[str, ...]
    findings: tuple[Finding, ...] = ()
    wedge: Wedge | None = None
    renamed: Mapping[str, str] = field(default_factory=dict)
