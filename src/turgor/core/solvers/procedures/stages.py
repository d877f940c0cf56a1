"""Stages: procedures one after the other, each of which begins where the last one ended."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from turgor.core.model.history import starts
from turgor.core.model.loads import Load
from turgor.core.model.obstacles import Vector
from turgor.core.model.supports import Displacement
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.procedures.static import Static
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import several


@dataclass(frozen=True, slots=True, kw_only=True)
class Stage:
    """One procedure of a sequence, and what it changes.

    All that acted at the end of the former stage stays unless it is stated here, pressures that were found included.
    What is stated goes from what it was to its new value. Its history is the share of this way over the load factor of
    this stage, which runs from 0 to 1; without one it goes in proportion to it.

    Parameters
    ----------
    name : str
        What messages and states call it.
    procedure : Static, VolumeControl, Sealed, GasMass, ArcLength, Auto, Stabilized or Dynamic
        How it is followed. `VolumeControl` injects in addition to what is there; `GasMass` seals what is there, at its
        pressure; `ArcLength` and `Auto` let the loads of the stage go from what they were towards their new values.
    loads : sequence of Load
        Loads that change: pressures by their face, tractions by their face, gravity. A pressure of 0 opens a cavity.
    displacements : sequence of Displacement
        Faces that are moved, from where they are; each takes the place of a `Displacement` or a `Fixed` of the model
        with the same face and directions.
    moves : mapping of str to (3,) floats [m]
        Obstacles that are moved: how far each is in the end from where it was at first.

    Raises
    ------
    TurgorError
        If the name is empty.

    Examples
    --------
    >>> from turgor.core.model.loads import Gravity
    >>> Stage("weight", loads=[Gravity((0, 0, -1))]).procedure.first_step
    0.05
    """

    name: str = field(kw_only=False)
    procedure: Procedure = field(default_factory=Static, kw_only=False)
    loads: tuple[Load, ...] = ()
    displacements: tuple[Displacement, ...] = ()
    moves: Mapping[str, Vector] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not self.name.strip():
            raise TurgorError("a stage has no name; a word is needed, such as 'fill'.")
        object.__setattr__(self, "loads", tuple(self.loads))
        for load in self.loads:
            if load.acts_at_rest and starts(load.history):
                raise TurgorError(
                    f"stage '{self.name}': the history of {load.label} begins with {load.share(0.0):g}; within a stage "
                    "a load goes from what it was, so begin with 0."
                )
        what = f"stage '{self.name}': displacements"
        example = 'a Displacement is needed, such as Displacement("tip", (0, 0, "1 mm"))'
        moves = several(self.displacements, Displacement, what, example)
        object.__setattr__(self, "displacements", moves)


@dataclass(frozen=True, slots=True)
class Stages(Procedure):
    """Procedures in turn: the weight first, then the pressure; fill, seal, press.

    The loads of the model itself act in the first stage. Contact, friction and what the rubber remembers go on from
    stage to stage, and so does the time, where stages know one.

    Parameters
    ----------
    stages : sequence of Stage
        At least one; each name once.

    Raises
    ------
    TurgorError
        If there is none, a name is there twice, or a procedure cannot continue another one.

    Examples
    --------
    >>> from turgor.core.solvers.procedures.sealed import Sealed
    >>> from turgor.core.solvers.procedures.volume_control import VolumeControl
    >>> from turgor.units import mL
    >>> press = Stage("press", Sealed(), moves={"plate": (0, 0, -2e-3)})
    >>> [stage.name for stage in Stages([Stage("fill", VolumeControl(volume=5 * mL)), press]).stages]
    ['fill', 'press']
    """

    stages: tuple[Stage, ...] = field()  # without the default of its base

    def __post_init__(self) -> None:
        object.__setattr__(self, "stages", tuple(self.stages))
        if not self.stages:
            raise TurgorError("there are no stages; at least one is needed.")
        names = [stage.name for stage in self.stages]
        for name in names:
            if names.count(name) > 1:
                raise TurgorError(f"{names.count(name)} stages are called '{name}'; give each a name of its own.")
        for number, stage in enumerate(self.stages):
            check_stage(stage, number)

    def parts(self, until: str = "") -> tuple[Procedure, ...]:
        """Return the procedures up to that of a stage; all of them where none has the name."""
        names = [stage.name for stage in self.stages]
        count = names.index(until) + 1 if until in names else len(names)
        return tuple(stage.procedure for stage in self.stages[:count])


def check_stage(stage: Stage, number: int) -> None:
    """Refuse a procedure that cannot be a stage, or not at its place.

    Parameters
    ----------
    stage : Stage
    number : int
        Its place in the sequence, from 0.

    Raises
    ------
    TurgorError
        If it cannot; the message says what to write instead.
    """
    procedure, subject = stage.procedure, f"stage '{stage.name}'"
    if not isinstance(procedure, Procedure) or procedure.stages:
        raise TurgorError(f"{subject}: {type(procedure).__name__} is no procedure; take one such as Static or Sealed.")
    try:
        procedure.check_stage(number)
    except TurgorError as error:
        raise TurgorError(f"{subject}: {error}") from None
