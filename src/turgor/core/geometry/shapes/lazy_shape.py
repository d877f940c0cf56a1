"""Late shape: a CAD shape that is made when something first asks for more than its size."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

Corner = tuple[float, float, float]


@dataclass(slots=True, kw_only=True, eq=False)
class LateShape:
    """The CAD shape of a geometry from the cache on disk, built when it is needed.

    Parameters
    ----------
    build : callable
        Builds the actuator; its geometry holds the shape.
    bounding_box : pair of (3,) tuples
        Lowest and highest corner of the triangulated shape, in CAD units.
    """

    build: Callable[[], Any]
    bounding_box: tuple[Corner, Corner]
    _shape: Any = field(default=None, init=False)

    def shape(self) -> Any:
        """Make the CAD shape, once, with the triangulation that the box is that of."""
        if self._shape is None:
            self._shape = self.build().shape
            self._shape.MakeTriangulation()
        return self._shape

    def __reduce__(self) -> tuple[Callable[..., "LateShape"], tuple[Any, ...]]:
        return _again, (self.build, self.bounding_box)


def _again(build: Callable[[], Any], bounding_box: tuple[Corner, Corner]) -> LateShape:
    return LateShape(build=build, bounding_box=bounding_box)
