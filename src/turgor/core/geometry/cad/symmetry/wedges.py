"""Wedges of a CAD part: which one is meant, and the part that is left of it."""

from collections.abc import Sequence

from turgor.core.geometry.cad.part import Part
from turgor.core.geometry.cad.symmetry.find import PartSymmetry, joined_by_turn
from turgor.core.geometry.cad.symmetry.modeled_share import Modeled
from turgor.core.geometry.cad.symmetry.requested import RequestedSymmetry
from turgor.core.geometry.cad.symmetry.sector import sector
from turgor.core.geometry.cad.symmetry.settings import SYMMETRY
from turgor.core.geometry.wedge import Wedge
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm


def requested_wedge(part: Part, names: Sequence[str], symmetry: PartSymmetry, fold: int | None) -> Wedge:
    """The wedge that is requested by name, with the largest number of sectors where none is given.

    Raises
    ------
    TurgorError
        If the part is not the same after each of so many turns, or a turn joins faces with names of their own.
    """
    if not symmetry.axis:
        raise TurgorError(
            f"symmetry: '{part.path}' is not the same after any turn about x, y or z by less than a whole one, so that "
            f"it has no wedge; it has: {symmetry}. Its axis must be along x, y or z."
        )
    wedge = _wedge(symmetry, fold or symmetry.fold or SYMMETRY.sectors)
    joined = joined_by_turn(part, names, symmetry, wedge.fold)
    if joined is None:
        raise TurgorError(
            f"symmetry: '{part.path}' is not the same after a turn of 1/{wedge.fold} about {symmetry.axis}; it is the "
            f"same after each of {symmetry.fold} turns about {symmetry.axis}, and a number of sectors that divides "
            f"{symmetry.fold} can be used."
        )
    apart = [pair for pair in joined if not all(name.startswith("cavity") for name in pair)]
    if apart:
        raise TurgorError(
            f"symmetry: a turn of 1/{wedge.fold} about {symmetry.axis} maps '{apart[0][0]}' onto '{apart[0][1]}'; give "
            "both the same name to model a wedge."
        )
    return wedge


def smaller_wedge(
    part: Part, names: Sequence[str], symmetry: PartSymmetry, requested: RequestedSymmetry, share: int
) -> Wedge | None:
    """The wedge of a part, if it is a smaller share than 1/share and loads and names allow it."""
    if not symmetry.axis or symmetry.axis in requested.broken_turns:
        return None
    if symmetry.fold == 0 and share > 1:
        return None  # a quarter becomes axisymmetric if that is requested
    wedge = _wedge(symmetry, symmetry.fold or SYMMETRY.sectors)
    if wedge.fold <= max(share, 2):
        return None  # a half is as good between mirror planes, and a body that reaches its axis has no other
    return None if joined_by_turn(part, names, symmetry, wedge.fold) else wedge


def cut_to_wedge(part: Part, names: Sequence[str], wedge: Wedge) -> Modeled:
    """Cut a sector out of a part; cavities that a turn joins get one name."""
    renamed = _together(part, names, wedge)
    own, cut = sector(part, [renamed.get(name, name) for name in names], wedge)
    return Modeled(part=own, names=cut, findings=(_finding(wedge, renamed),), wedge=wedge, renamed=renamed)


def _wedge(symmetry: PartSymmetry, fold: int) -> Wedge:
    x, y, z = symmetry.center
    return Wedge(axis=symmetry.axis, fold=fold, center=(x * mm, y * mm, z * mm))


def _together(part: Part, names: Sequence[str], wedge: Wedge) -> dict[str, str]:
    """One name for the cavities that turns join: ``cavity`` if they are all, else the first of them."""
    x, y, z = (value / mm for value in wedge.center)
    symmetry = PartSymmetry(mirrors=(), axis=wedge.axis, fold=wedge.fold, center=(x, y, z))
    first = {name: name for name in names if name.startswith("cavity")}
    for one, other in joined_by_turn(part, names, symmetry, wedge.fold) or ():
        low, high = sorted((first[one], first[other]))
        first = {name: low if leader == high else leader for name, leader in first.items()}
    leaders = sorted(set(first.values()))
    if len(leaders) == 1 and len(first) > 1:
        return dict.fromkeys(first, "cavity")
    return {name: leader for name, leader in first.items() if leader != name}


def _finding(wedge: Wedge, renamed: dict[str, str]) -> Finding:
    """Say what is modeled."""
    names = {name: sorted(each for each, to in renamed.items() if to == name) for name in renamed.values()}
    together = "".join(f" '{name}' stands for {', '.join(each)}, under one pressure." for name, each in names.items())
    return Finding(
        code="D07",
        severity=Severity.NOTE,
        message=f"A wedge of 1/{wedge.fold} of the part about {wedge.axis} is modeled: its two cut faces move alike, "
        f"turned by {360 / wedge.fold:.4g}°.{together}",
        advice="Volumes, forces and pictures are those of the whole. A wedge cannot bend or buckle to the side, and "
        'its walls do not touch those of the next sector; symmetry = "none" models the whole part.',
    )
