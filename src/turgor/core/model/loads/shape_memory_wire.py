"""ShapeMemoryWire: a wire through guides on the surface, fastened at both ends, that contracts when it is heated."""

from collections.abc import Container, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import TYPE_CHECKING, Any

from turgor.core.materials.alloys.alloy import ShapeMemoryAlloy, given_alloy
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, History, checked
from turgor.core.model.history_text import shares_text
from turgor.core.model.loads.images import refuse_in_sectors
from turgor.core.model.loads.load import Load, Vector
from turgor.core.model.loads.temperature import FREEZING, ROOM
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantities, Quantity, checked_guides, number
from turgor.foundation.given import name as name_of
from turgor.units import mm

#: Temperatures [K] of wires: below, no alloy in use is austenite; above, all of them lose their memory.
COLDEST, HOTTEST = 100.0, 1000.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ShapeMemoryWire(Load):
    """A wire of a shape-memory alloy that runs straight from guide to guide, without friction, fastened at both ends.

    It was stretched by a strain before it was mounted, and is free of stress in the shape of the mesh. Heated, it
    becomes austenite and pulls. The martensite of a state depends on all states before it. A wire does not push: it
    goes slack.

    Parameters
    ----------
    through : sequence of (3,) floats [m]
        Points of the surface at rest, at least two.
    diameter : float [m]
        Of the wire, without stress.
    alloy : str, ShapeMemoryAlloy or mapping
        Name of a published alloy, or its constants.
    strain : float
        By which it was stretched before it was mounted, 0 to the transformation strain of the alloy.
    temperature : float [K]
        What it becomes at a share of one; ``"80 °C"`` is understood, too.
    rest : float [K]
        Temperature at which it was mounted; 20 °C by default.
    name : str
        What a later stage, which heats or cools it, and measures call it; each wire of a model has its own.
    history : sequence of (float, float), or str, optional
        As that of a `Pressure`: the share of the way from ``rest`` to ``temperature``.

    Raises
    ------
    TurgorError
        If a number is not allowed, there are fewer than two points, or two neighbors coincide.

    Examples
    --------
    >>> wire = ShapeMemoryWire(
    ...     through=[(0, 0, 5e-3), (0.08, 0, 5e-3)], diameter="0.25 mm", alloy="nitinol-brinson-1993", strain="4 %",
    ...     temperature="80 °C",
    ... )
    >>> wire.words
    'Shape-memory wire through 2 points goes from 20 °C to 80 °C'
    """

    through: tuple[Vector, ...] = field(metadata={"dimension": "length"})
    diameter: float = field(metadata={"dimension": "length"})
    alloy: ShapeMemoryAlloy = field(metadata={"table": True, "example": '"nitinol-brinson-1993"'})
    strain: float = field(metadata={"dimension": "share"})
    temperature: float = field(metadata={"dimension": "temperature"})
    rest: float = field(default=ROOM, metadata={"dimension": "temperature"})
    name: str = "wire"
    history: History = RAMP

    job_key = "wires"
    #: Whether heat drives it.
    heated = True
    spread = False
    lasting = True

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            through: Sequence[Quantities],
            diameter: Quantity,
            alloy: str | ShapeMemoryAlloy | dict[str, Any],
            strain: Quantity,
            temperature: Quantity,
            rest: Quantity = ROOM,
            name: str = "wire",
            history: History = RAMP,
        ) -> None: ...

    def __post_init__(self) -> None:
        subject = f"wire '{name_of(self.name, 'wire', 'name')}'"
        object.__setattr__(self, "through", checked_guides(self.through, subject))
        object.__setattr__(self, "alloy", given_alloy(self.alloy))
        diameter = number(self.diameter, f"{subject}: diameter", "length")
        if not (diameter > 0 and isfinite(diameter)):
            raise TurgorError(f"{subject}: diameter is {diameter / mm:g} mm; it must be above 0.")
        object.__setattr__(self, "diameter", diameter)
        for key in ("temperature", "rest"):
            value = number(getattr(self, key), f"{subject}: {key}", "temperature")
            if not COLDEST <= value <= HOTTEST:
                raise TurgorError(
                    f"{subject}: {key} is {value:g} K; allowed is {COLDEST:g} K to {HOTTEST:g} K. A number without "
                    'a unit is in kelvin; write "70 °C".'
                )
            object.__setattr__(self, key, value)
        strain, most = number(self.strain, f"{subject}: strain", "share"), self.alloy.transformation_strain
        if not 0 <= strain <= most:
            raise TurgorError(f"{subject}: strain is {strain:g}; allowed is 0 to {most:g}, the transformation strain.")
        if strain and self.rest >= self.alloy.austenite_start:
            raise TurgorError(
                f"{subject}: rest is {self.rest - FREEZING:.4g} °C, where the alloy becomes austenite without stress; "
                f"a wire that was stretched stays so below {self.alloy.austenite_start - FREEZING:.4g} °C."
            )
        object.__setattr__(self, "strain", strain)
        object.__setattr__(self, "history", checked(self.history, subject))

    @property
    def place(self) -> str:
        """Its name."""
        return self.name

    @property
    def label(self) -> str:
        """Its class and its name."""
        return f"ShapeMemoryWire({self.name})"

    @property
    def words(self) -> str:
        """Number of points, and the temperatures."""
        ends = [f"{value - FREEZING:.4g} °C" for value in (self.rest, self.temperature)]
        return f"Shape-memory wire through {len(self.through)} points goes from {ends[0]} to {ends[1]}"

    def text(self) -> str:
        """Return the sentence of a report."""
        return (
            f"{self.words}{shares_text(self.history)}; it has a diameter of {self.diameter / mm:g} mm and was "
            f"stretched by {100 * self.strain:g} % before it was mounted."
        )

    def turned(self, axis: int) -> bool:
        """A wire is elsewhere after a turn."""
        return False

    def check(self, mesh: Mesh, points: Container[str]) -> None:
        """Refuse sectors of a wedge; whether the points are on the surface is checked by the equations."""
        refuse_in_sectors(mesh, "a wire")

    @property
    def outside(self) -> bool:
        """The work of the wire is not that of a dead force."""
        return False

    @property
    def cable(self) -> "ShapeMemoryWire":
        """Itself."""
        return self

    def warming(self, load_factor: float) -> float:
        """Return by how much it is warmer than at rest at a load factor [K]."""
        return self.share(load_factor) * (self.temperature - self.rest)

    @property
    def path_dependent(self) -> str:
        """Its martensite."""
        return "the martensite of a wire"

    @property
    def alone(self) -> str:
        """What to do where two loads contradict each other."""
        return (
            "give each wire a name of its own. A stage that heats a wire repeats its through, diameter, alloy, strain "
            "and rest."
        )

    def of_same(self, other: "ShapeMemoryWire") -> bool:
        """Whether two loads heat one wire."""
        return all(
            getattr(self, key) == getattr(other, key) for key in ("through", "diameter", "alloy", "strain", "rest")
        )
