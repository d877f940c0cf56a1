"""EmbeddedThreads: threads, rods or wires inside the body, which run straight from point to point."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, checked_guides


@dataclass(frozen=True, slots=True, kw_only=True)
class EmbeddedThreads:
    """Threads that run straight from point to point inside the body, and follow it all along.

    They are the winding of `Fibers` without a face, whose form is ``"discrete"``.

    Parameters
    ----------
    through : sequence of sequences of (3,) floats [m]
        Points of each thread at rest, at least two; each is in the body or on its surface.

    Raises
    ------
    TurgorError
        If there is no thread, one has fewer than two points, or two neighbors coincide.

    Examples
    --------
    >>> EmbeddedThreads(through=[[(0, 0, 0), ("20 mm", 0, 0)]]).through
    (((0.0, 0.0, 0.0), (0.02, 0.0, 0.0)),)
    """

    through: tuple[tuple[tuple[float, float, float], ...], ...]

    if TYPE_CHECKING:

        def __init__(self, *, through: Sequence[Sequence[Quantities]]) -> None: ...

    def __post_init__(self) -> None:
        if not isinstance(self.through, list | tuple) or not self.through:
            raise TurgorError(f"embedded threads: through is {self.through!r}; points of at least one are needed.")
        for thread in self.through:
            if not isinstance(thread, list | tuple) or not all(isinstance(point, list | tuple) for point in thread):
                raise TurgorError(
                    f"embedded threads: through has {thread!r}; each thread is a list of its points, such as "
                    "[(0, 0, 0), (0.02, 0, 0)]."
                )
        lines = (checked_guides(each, f"embedded thread {k}") for k, each in enumerate(self.through, start=1))
        object.__setattr__(self, "through", tuple(lines))
