"""Results of checks of a mesh alone: computed once per mesh in a process, and saved on disk with the mesh."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache, wraps
from typing import TypeVar

from turgor.core.meshing.mesh import Mesh

Result = TypeVar("Result")


@dataclass(slots=True, eq=False)
class CheckResults:
    """Results of checks of a mesh.

    Parameters
    ----------
    by_check : dict of str to object
        Results by the names of the checks.
    saved : int
        How many of them are on disk.
    """

    by_check: dict[str, object] = field(default_factory=dict)
    saved: int = 0


@lru_cache(maxsize=4)  # the next run of a sweep often has the same mesh
def check_results(mesh: Mesh) -> CheckResults:
    """Return the results for a mesh, to which each check adds its own.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    CheckResults
        The same object for each call, while the mesh is one of the last ones.
    """
    return CheckResults()


def once_per_mesh(check: Callable[[Mesh], Result]) -> Callable[[Mesh], Result]:
    """Decorate a function of a mesh alone: its result is computed once.

    An entry on disk is named after the sources of `turgor.core.geometry` and `turgor.core.meshing`. So the function,
    and all that it calls, must lie there. The result is plain, or of dataclasses: what a file can hold.

    Parameters
    ----------
    check : callable
        ``check(mesh)``; its result must not be changed.

    Returns
    -------
    callable
    """
    name = _name(check)

    @wraps(check)
    def checked(mesh: Mesh) -> Result:
        results = check_results(mesh).by_check
        if name not in results:
            results[name] = check(mesh)
        return results[name]  # type: ignore[return-value]  # by its name, it is what the check returned

    return checked


def hand_on(checked: Callable[[Mesh], object], mesh: Mesh, finer: Mesh) -> None:
    """Give a finer mesh of the same shape the result of a check that cells do not change.

    Parameters
    ----------
    checked : callable
        Decorated by `once_per_mesh`.
    mesh, finer : Mesh
    """
    check_results(finer).by_check.setdefault(_name(checked), checked(mesh))


def _name(check: Callable[[Mesh], object]) -> str:
    return f"{check.__module__}.{check.__qualname__}"
