"""Procedure: the base of all procedures, with everything that follows from one.

A procedure is a frozen dataclass that inherits `Procedure`, mostly through `StepOptions`, in a file of its own. It
answers what the solver, mesh errors, gradients, reports and job files need to know; nothing else asks for its class.
What it leaves out has the default that stands here.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Any, ClassVar

from turgor.core.model.loads.channel import closed_cavities
from turgor.core.model.model import Model
from turgor.core.model.places import NodesAt
from turgor.core.solvers.procedures.channel_flow import refuse_channels
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity


@dataclass(frozen=True, slots=True)
class DeckStep:
    """The kind of step of an .inp file.

    Parameters
    ----------
    keyword : str
        The keyword with its options.
    differs : str
        How it differs from the procedure, after the keyword; empty where it is the same.
    first, most : float
        First and longest increment of time, where the procedure states them.
    more : str
        What follows the increments of time on their line.
    damping : (float, float)
        Rayleigh's coefficients of the mass [1/s] and the stiffness [s].
    velocity : (3,) floats [m/s]
        Of the whole body at the start.
    """

    keyword: str
    differs: str = ""
    first: float = inf
    most: float = inf
    more: str = ""
    damping: tuple[float, float] = (0.0, 0.0)
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)


class Procedure:
    """How a path is followed, and all that follows from it; `Static`, `Dynamic`, `Stages` and the like inherit it.

    Arguments that have no type here are those of the solvers, which know procedures by this class only.

    Examples
    --------
    >>> from turgor.core.solvers.procedures.volume_control import VolumeControl
    >>> procedure = VolumeControl(volume=5e-6)
    >>> procedure.drive, procedure.drive_unit, procedure.requested, procedure.parts() == (procedure,)
    ('injected_volume', 'mL', 5e-06, True)
    """

    __slots__ = ()

    #: Load factors that must be hit exactly besides 1.
    at: tuple[float, ...] = ()
    #: Time at load factor 1 [s]; None where it has no time.
    duration: float | None = None
    #: Largest relative residual, and the iterations before a step is cut back.
    tolerance: float = 1e-6
    max_iterations: int = 15
    #: Whether cells that degrade are cut on the way.
    remesh: bool = False
    #: Stages of a sequence; none in a single procedure.
    stages: tuple[Any, ...] = ()

    #: Whether it steps the load factor and nothing else, so that a guide may predict its steps.
    load_control: ClassVar[bool] = False
    #: Whether the load factor is unknown, as along an arc.
    finds_load: ClassVar[bool] = False
    #: Column of what it prescribes in cavities, whose pressures are unknown then, and its unit; ratios have none.
    drive: ClassVar[str] = ""
    drive_unit: ClassVar[str] = ""
    #: Whether masses matter.
    has_inertia: ClassVar[bool] = False
    #: Whether its states have energies.
    has_energies: ClassVar[bool] = False
    #: Why every state depends on all before it, whatever the model; such paths have no gradients and no mesh error.
    depends_on_path: ClassVar[str] = ""
    #: Severity of the finding that the path goes through limit points (L03).
    limit_points: ClassVar[Severity] = Severity.NOTE

    def follow(self, problem: Any) -> Any:
        """Follow the path: fill the lists of a `turgor.core.solvers.problem.Problem`, and return its outcome."""
        raise TurgorError(f"{type(self).__name__} is no procedure that can be solved; it has no method follow.")

    def parts(self, until: str = "") -> tuple[Any, ...]:
        """Return the procedures of a sequence up to that of a stage, all without one; of any other itself alone."""
        return (self,)

    def check_stage(self, number: int) -> None:
        """Refuse to be the stage of a number, from 0."""
        if self.remesh:
            raise TurgorError("remesh is for a procedure without stages, because all states must lie on one mesh.")

    @property
    def requested(self) -> float | Mapping[str, float] | None:
        """The value requested for all cavities or by their names; None where it prescribes none."""
        return None

    def filled(self, model: Model) -> tuple[str, ...]:
        """Name the cavities for which it prescribes a value."""
        return ()

    def emptied(self, model: Model) -> tuple[str, ...]:
        """Name the cavities whose walls it may bring together."""
        return ()

    def controlled(self, model: Model) -> tuple[str, ...]:
        """Name the cavities whose pressure is unknown, after a check that it can be found."""
        refuse_channels(model, type(self).__name__)
        return ()

    def target(self, chambers: Any, volumes: Any, pressures: Any) -> Any:
        """Return the conditions for the pressures of cavities, from their scaled volumes and pressures at the start."""
        raise TurgorError(f"{type(self).__name__} finds no pressures.")

    def amounts(self, chambers: Any, volumes: Any) -> Any:
        """Return what it prescribes in each cavity (k,) [SI] as a function of the load factor, as `target` does."""
        raise TurgorError(f"{type(self).__name__} finds no pressures.")

    @property
    def turns(self) -> tuple[float, ...]:
        """Load factors at which other conditions begin."""
        return ()

    def driven_text(self, now: Mapping[str, float], first: Mapping[str, float]) -> str:
        """Say what is prescribed in a state, from the columns of it and of the first state; empty where nothing is."""
        return ""

    def may_be_free(self, model: Model) -> bool:
        """Whether supports may leave rigid motions free."""
        return False

    def deck_step(self, program: str, relaxes: bool) -> DeckStep:
        """Return its step in .inp files.

        Parameters
        ----------
        program : str
            ``"abaqus"`` or ``"calculix"``.
        relaxes : bool
            Whether a rubber relaxes.

        Raises
        ------
        TurgorError
            If the program has none, or it seeks pressures, which the file must state.
        """
        raise TurgorError(
            f"the procedure {type(self).__name__} seeks what .inp files must state; export a job with static, whose "
            "pressures are those of a run of this one."
        )

    @property
    def no_gradient(self) -> str:
        """Why its own states have no derivative, and what to do; empty where they have one."""
        if self.remesh:
            return "states before the last cut of cells are no equilibria on the cells after it; leave remesh out"
        return ""

    def findings(self, states: Sequence[Any]) -> tuple[Finding, ...]:
        """Return what the energies of the states show."""
        return ()


def with_contact_within(model: Model, procedure: Procedure) -> Model:
    """Return a model whose walls may touch within the cavities that a procedure empties, or liquid may flow out of.

    Parameters
    ----------
    model : Model
    procedure : Procedure
        One, or stages.
    """
    emptied = {name for part in procedure.parts() for name in part.emptied(model)}
    emptied |= set(closed_cavities([*model.loads, *(load for stage in procedure.stages for load in stage.loads)]))
    if not emptied or model.contact.self_contact is None:
        return model
    emptied |= set(model.contact.self_contact.cavities or ())
    names = tuple(name for name in model.mesh.cavities if name in emptied)
    return replace(model, contact=model.contact.with_cavities(names))


def refuse_remeshing(model: Model) -> None:
    """Refuse a model whose cells cannot be cut on the way.

    Parameters
    ----------
    model : Model

    Raises
    ------
    TurgorError
        Naming what cannot be carried over.
    """
    mesh = model.mesh
    reasons = {
        "a film without a solid has no cells that could degrade": not len(mesh.cells),
        "cells of 20 nodes cannot be cut in a wedge or a revolved mesh": mesh.cells.shape[1] == 20
        and (bool(mesh.revolved) or mesh.wedge is not None),
        "liquid that flows through a channel cannot be carried over": any(load.channel for load in model.loads),
        "the damage of a bond cannot be carried over": bool(model.bonds),
    }
    off = [each.name for each in _points_near(model) if not each.at_node(mesh)]
    reasons |= {f"the node nearest to the point of '{name}' may be another one on finer cells": True for name in off}
    for reason, holds in reasons.items():
        if holds:
            raise TurgorError(
                f"procedure.remesh: {reason}; leave remesh out, and mesh the body finer where it degrades."
            )


def _points_near(model: Model) -> list[NodesAt]:
    """Places of supports and loads that are the node nearest to a point."""
    places = [getattr(each, "face", None) for each in (*model.supports, *model.loads)]
    places += [place for each in model.supports for place, *_ in getattr(each, "terms", ())]
    return [each for each in places if isinstance(each, NodesAt) and each.near is not None]
