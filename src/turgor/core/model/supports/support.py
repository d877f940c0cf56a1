"""Support: the base of all supports, with what follows from one.

A support is a frozen dataclass that inherits `Support`. As a load does, it answers what models, stages and reports need
to know; what it leaves out has the default that stands here.
"""

from typing import Any, ClassVar

from turgor.core.model.history import History
from turgor.foundation.errors import TurgorError


class Support:
    """What holds an actuator, and what follows from it; `Fixed`, `ReferencePoint` and the like inherit it.

    Examples
    --------
    >>> from turgor.core.model.supports import Fixed
    >>> support = Fixed("fixed", "xz")
    >>> support.place, support.prescribed, support.text()
    ('fixed', ('fixed', 'xz'), 'fixed does not move in x, z.')
    """

    __slots__ = ()

    #: Whether the traction may jump across its face.
    jumps: ClassVar[bool] = True
    #: Whether it may move an actuator, which then works on what moves it.
    moves: ClassVar[bool] = False

    @property
    def place(self) -> str:
        """Name of the face or point that it holds."""
        return str(getattr(self, "face", getattr(self, "point", "")))

    @property
    def label(self) -> str:
        """The support in a few letters, such as ``"Fixed(fixed)"``."""
        return f"{type(self).__name__}({self.place})"

    @property
    def named_faces(self) -> tuple[str, ...]:
        """Faces that the mesh must have."""
        face = getattr(self, "face", None)
        return () if face is None else (face,)

    @property
    def prescribed(self) -> tuple[str, str]:
        """Face or point whose displacement it prescribes, and the directions; empty of other supports."""
        return "", ""

    @property
    def turned_point(self) -> str:
        """Reference point whose rotation it prescribes; empty of other supports."""
        return ""

    @property
    def way(self) -> History | None:
        """History of what it prescribes; None where nothing is moved, or a function says where."""
        return None

    def text(self) -> str:
        """Return the sentence of a report."""
        return f"{type(self).__name__} of {self.place}."

    def as_moved(self) -> "Support":
        """Return a support that later stages can move: a displacement of zero for a face that is fixed."""
        return self

    def continued(self, factor: float, new: Any) -> "Support":
        """Return the support of the next stage, which begins at a load factor of this one.

        Parameters
        ----------
        factor : float
            Load factor at which this stage ended.
        new : Displacement or None
            What replaces it.
        """
        return self


def check_directions(directions: object, what: str) -> None:
    """Refuse directions that are not some of x, y and z."""
    if not isinstance(directions, str) or not set(directions) <= set("xyz") or not directions:
        raise TurgorError(f"{what}: directions is {directions!r}; some of x, y and z are needed, such as 'xz'.")
