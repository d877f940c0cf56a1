"""Supports of a job file: for each face the directions in which it is fixed, its radius, or that it stays plane.

A file in `turgor.core.model.supports` whose class states ``job_texts`` is all that a new one needs.
"""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from turgor.core.geometry.geometry import Geometry
from turgor.core.model.supports import Fixed, Support
from turgor.foundation.errors import unknown
from turgor.foundation.registry import Registry, class_of_file
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import shown

#: Supports by the name of their file: the classes in their folder.
SUPPORTS: Registry[type[Support]] = Registry(
    "turgor.core.model.supports", class_of_file(lambda kind: issubclass(kind, Support) and kind is not Support)
)


def stated_supports() -> dict[str, Callable[[str], Support]]:
    """Return what makes the support of a face by the text that states it.

    Examples
    --------
    >>> stated_supports()["radial about y"]("outside")
    Radial(face='outside', axis=(0.0, 1.0, 0.0))
    """
    kinds: list[Any] = list(SUPPORTS.values())
    return {text: partial(kind, **values) for kind in kinds for text, values in kind.job_texts.items()}


def read_supports(values: Any, geometry: Geometry | None, problems: Problems) -> tuple[Support, ...]:
    """Read ``[supports]``: for each face the directions in which it is fixed, ``"radial"`` or ``"plane section"``."""
    if not isinstance(values, Mapping):
        problems.add(("supports",), f"{shown(values)} is not a table; write [supports] and faces below it.")
        return ()
    supports: list[Support] = []
    by_text = stated_supports()
    for face, stated in values.items():
        key = ("supports", face)
        if geometry is not None and face not in geometry.faces:
            problems.add(key, str(unknown("face", face, geometry.faces)))
        elif isinstance(stated, str) and stated in by_text:
            supports.append(by_text[stated](face))
        elif not isinstance(stated, str) or not stated or not set(stated) <= set("xyz"):
            allowed = ", ".join(f"'{name}'" for name in by_text)
            problems.add(
                key,
                f"{shown(stated)} is not allowed; name the fixed directions, such as 'xyz' or 'z', or one "
                f"of {allowed}.",
            )
        else:
            supports.append(Fixed(face, stated))
    return tuple(supports)
