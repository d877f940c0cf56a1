"""Headline: the title of a report, and what part of the actuator was computed."""

import re

from turgor.core.meshing.mesh import Mesh
from turgor.core.solvers.solution import Solution
from turgor.units import kPa, mm

#: End of the name of a mesh that is a part of the actuator.
_PART = re.compile(r", (half|quarter|eighth)$")


def headline(of: Solution) -> str:
    """Return the title of a report: the whole actuator and the largest gauge pressure of the path.

    Parameters
    ----------
    of : Solution
        The path.

    Returns
    -------
    str
        Such as ``"Fast PneuNet, 11 chambers, under 22.5 kPa"``.
    """
    name = _PART.sub("", of.model.mesh.name).replace("_", " ") or "actuator"
    pressures = [abs(value) for state in of.states for value in state.pressures.values()]
    largest = max(pressures, default=0.0)
    driven = largest > 0 and bool(of.model.pressures)
    return f"{name[0].upper()}{name[1:]}{f', up to {largest / kPa:.4g} kPa' if driven else ''}"


def modeled_part(of: Mesh) -> str:
    """Say what part of the actuator was computed; empty for the whole.

    Parameters
    ----------
    of : Mesh

    Returns
    -------
    str
        A sentence or two.
    """
    whole = "Numbers, curves and pictures are those of the whole actuator."
    if of.wedge is not None:
        return (
            f"One sector of {of.wedge.fold} about the axis {of.wedge.axis} was computed; the others repeat it. {whole}"
        )
    planes = [_plane(axis, place) for axis, place in of.mirror_planes]
    if not planes:
        return ""
    share = {1: "One half", 2: "A quarter", 3: "An eighth"}[len(planes)]
    which = f"plane {planes[0]} gives" if len(planes) == 1 else f"planes {' and '.join(planes)} give"
    return f"{share} of the actuator was computed; the mirror {which} the rest. {whole}"


def _plane(axis: int, place: float) -> str:
    return f"{'xyz'[axis]} = {f'{place / mm:.4g} mm' if abs(place) > 1e-6 * mm else '0'}"
