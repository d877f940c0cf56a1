"""Supports of a job file: for each face the directions in which it is fixed, its radius, or that it stays plane."""

from collections.abc import Mapping
from typing import Any

from turgor.core.geometry.directions import AXES, Vector
from turgor.core.geometry.geometry import Geometry
from turgor.core.model.supports import Fixed, PlaneSection, Radial
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import shown

#: Text of a support that holds the radius of a face, by the axis of its cylinder.
RADIAL: Mapping[str, Vector] = {"radial": AXES["x"], **{f"radial about {axis}": AXES[axis] for axis in "yz"}}

#: Text of a support that keeps a section plane.
PLANE = "plane section"

#: Supports that a job file can state.
StatedSupport = Fixed | Radial | PlaneSection


def read_supports(values: Any, geometry: Geometry | None, problems: Problems) -> tuple[StatedSupport, ...]:
    """Read ``[supports]``: for each face the directions in which it is fixed, ``"radial"`` or ``"plane section"``."""
    if not isinstance(values, Mapping):
        problems.add(("supports",), f"{shown(values)} is not a table; write [supports] and faces below it.")
        return ()
    supports: list[StatedSupport] = []
    for face, stated in values.items():
        key = ("supports", face)
        if geometry is not None and face not in geometry.faces:
            problems.add(key, str(unknown("face", face, geometry.faces)))
        elif isinstance(stated, str) and stated in RADIAL:
            supports.append(Radial(face, RADIAL[stated]))
        elif stated == PLANE:
            supports.append(PlaneSection(face))
        elif not isinstance(stated, str) or not stated or not set(stated) <= set("xyz"):
            allowed = ", ".join(f"'{name}'" for name in (*RADIAL, PLANE))
            problems.add(
                key,
                f"{shown(stated)} is not allowed; name the fixed directions, such as 'xyz' or 'z', or one "
                f"of {allowed}.",
            )
        else:
            supports.append(Fixed(face, stated))
    return tuple(supports)


def support_text(support: StatedSupport) -> str:
    """Write how a face is supported; `read_supports` gives the same support back."""
    if isinstance(support, Fixed):
        return support.directions
    if isinstance(support, PlaneSection):
        return PLANE
    for name, axis in RADIAL.items():
        if axis == tuple(support.axis):
            return name
    raise TurgorError(f"the axis {support.axis} of a radial support has no form in a job file; it is x, y or z there.")
