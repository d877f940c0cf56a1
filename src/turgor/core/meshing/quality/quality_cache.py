"""Answers to questions about a mesh alone: asked once in a process, and kept on disk with the mesh."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache, wraps
from typing import TypeVar

from turgor.core.meshing.mesh import Mesh

Answer = TypeVar("Answer")


@dataclass(slots=True, eq=False)
class Answers:
    """What is known of a mesh.

    Parameters
    ----------
    known : dict of str to object
        Answers by the names of the questions.
    on_disk : int
        How many of them are on disk.
    """

    known: dict[str, object] = field(default_factory=dict)
    on_disk: int = 0


@lru_cache(maxsize=4)  # the next run of a sweep often has the same mesh
def answers_of(mesh: Mesh) -> Answers:
    """Answers about a mesh; whoever asks or finds one adds it.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    Answers
        The same object for each call, while the mesh is one of the last ones.
    """
    return Answers()


def asked_once(question: Callable[[Mesh], Answer]) -> Callable[[Mesh], Answer]:
    """Keep the answers of a function of a mesh alone.

    An entry on disk is named after the sources of `turgor.core.geometry` and `turgor.core.meshing`, and so is true as
    long as the function, and all that it calls, lies there. The answer is plain, or of dataclasses: what a file can
    hold.

    Parameters
    ----------
    question : callable
        ``question(mesh)``; nobody may change what it returns.

    Returns
    -------
    callable
    """
    name = f"{question.__module__}.{question.__qualname__}"

    @wraps(question)
    def asked(mesh: Mesh) -> Answer:
        known = answers_of(mesh).known
        if name not in known:
            known[name] = question(mesh)
        return known[name]  # type: ignore[return-value]  # by its name, it is what the question returned

    return asked
