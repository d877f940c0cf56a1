"""Job: one run as values, independent of the file that stated it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Protocol

from turgor.errors import unknown
from turgor.geometry import FastPneuNet, Geometry
from turgor.materials.material import Material
from turgor.model.loads import Gravity, Pressure
from turgor.model.model import Membrane
from turgor.model.supports import Fixed
from turgor.solvers.procedures import Static


class Actuator(Protocol):
    """What every actuator family offers: dimensions as dataclass fields, and the shape that they make."""

    def build(self) -> Geometry:
        """Build the shape with its names."""


#: Actuator families by the name that job files use. A new family is one line here; its keys are its fields.
ACTUATORS: Mapping[str, type[Actuator]] = MappingProxyType({"fast_pneunet": FastPneuNet})


def actuator_type(actuator: Actuator) -> str:
    """Return the name that job files use for the family of an actuator.

    Examples
    --------
    >>> actuator_type(FastPneuNet())
    'fast_pneunet'
    """
    for name, family in ACTUATORS.items():
        if type(actuator) is family:
            return name
    raise unknown("actuator type", type(actuator).__name__, ACTUATORS)


def standard_measures() -> tuple[str, ...]:
    """Return the names of the measures that a run writes unless it is told otherwise.

    Examples
    --------
    >>> standard_measures()[0]
    'bending_angle'
    """
    from turgor.results.measures import STANDARD_MEASURES  # here, because it loads the engine

    return tuple(measure.name for measure in STANDARD_MEASURES)


@dataclass(frozen=True, slots=True, kw_only=True)
class Output:
    """What a run writes besides the response, the path and the lock file.

    Parameters
    ----------
    measures : tuple of str
        Names of the measures in ``response.csv``, in this order.
    fields : bool
        Whether to write the fields of every state for ParaView.
    pictures : bool
        Whether to draw the actuator, undeformed and deformed.
    report : bool
        Whether to write the HTML report.
    """

    measures: tuple[str, ...] = field(default_factory=standard_measures)
    fields: bool = True
    pictures: bool = True
    report: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Job:
    """One run: the actuator, how it is meshed, made, held, driven and followed, and what to write.

    Parameters
    ----------
    name : str
        What the run is called; the default folder of results is ``<name>-results``.
    actuator : Actuator
        Dimensions of the actuator.
    mesh_size : float [m]
        Largest edge length aimed at.
    mesh_grading : float [-]
        How fast cells may grow away from small ones.
    materials : mapping of str to Material or Membrane
        A material for every region and a membrane for every face that is reinforced.
    supports : tuple of Fixed
        What holds the actuator; mirror planes hold themselves.
    loads : tuple of Pressure or Gravity
        What drives it.
    procedure : Static
        How the path is followed.
    output : Output
        What to write.
    threads : int or None
        Processors to use; None takes all. The last digits of the results depend on it, nothing else.
    """

    name: str
    actuator: Actuator
    mesh_size: float
    mesh_grading: float = 0.5
    materials: Mapping[str, Material | Membrane]
    supports: tuple[Fixed, ...] = (Fixed("fixed"),)
    loads: tuple[Pressure | Gravity, ...]
    procedure: Static = field(default_factory=Static)
    output: Output = field(default_factory=Output)
    threads: int | None = None
