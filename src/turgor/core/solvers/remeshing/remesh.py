"""Remesh: cut the cells of a state where its error is, carry the state over, and find equilibrium again."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.cells.internal_variables import History, Memory
from turgor.core.engine.chamber_volumes import Chambers
from turgor.core.engine.energy import stored_energy
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.engine.transfer import Transfer
from turgor.core.model.model import Model
from turgor.core.solvers.constraints.cavities import CavityPressures, VolumeTarget
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.listeners import silent
from turgor.core.solvers.newton.contact_newton import newton_with_contact
from turgor.core.solvers.newton.newton_values import NewtonResult, NewtonSettings, Start
from turgor.core.solvers.procedures.procedure import Procedure, refuse_remeshing
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.remeshing.friction import carried_friction
from turgor.core.solvers.remeshing.indicator import error_indicator
from turgor.core.solvers.remeshing.refine import refined
from turgor.core.solvers.remeshing.settings import REMESHING
from turgor.core.solvers.restart import Restart, unknowns_of
from turgor.core.solvers.solution import State, Touch
from turgor.core.solvers.states import state_of
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: Of rubber that remembers nothing.
NO_MEMORY = Memory(stress={}, largest={})


@dataclass(frozen=True, slots=True, kw_only=True)
class TransferError:
    """How far a state was from equilibrium on finer cells, which hold all of its displacement: its own mesh error.

    Parameters
    ----------
    displacement : float [-]
        Norm of the change of the nodal displacements over their norm.
    energy : float [-]
        Change of the stored energy over that before; nan where none is stored.
    pressure : float [-]
        Largest change of an unknown pressure over that before; 0 where none is unknown.
    """

    displacement: float
    energy: float
    pressure: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Remeshed:
    """A state on finer cells.

    Parameters
    ----------
    state : State
        In equilibrium on the finer cells, at the load of the state before.
    transferred : State
        The state before on the finer cells, not in equilibrium there.
    transfer : Transfer
        Carries fields of the mesh before to the finer one.
    error : TransferError
    iterations : int
        Updates of Newton's method.
    residual : float [-]
        Relative residual of ``state``.
    restart : Restart
        From which a path goes on.
    """

    state: State
    transferred: State
    transfer: Transfer
    error: TransferError
    iterations: int
    residual: float
    restart: Restart

    __repr__ = brief


def remesh(
    state: State,
    procedure: Procedure | None = None,
    *,
    growth: float = REMESHING.growth,
    options: EngineOptions | None = None,
) -> Remeshed:
    """Cut the cells of a state where its error is, carry the state over, and find equilibrium at the same load.

    The new cells are exact pieces of the old ones. So displacement and mean stress are carried over without any error,
    and internal variables and the tractions of friction by a linear fit in each old cell or side. The change up to the
    new equilibrium is the error that the old cells had. The contact is rebuilt.

    Parameters
    ----------
    state : State
        Of a solution.
    procedure : Procedure, optional
        That of the solution: where it prescribes volumes, these stay and pressures change. `Static` by default.
    growth : float
        Number of cells afterwards over that before, aimed at; from 1 to 8, which cuts all edges.
    options : EngineOptions, optional

    Returns
    -------
    Remeshed

    Raises
    ------
    TurgorError
        If the state cannot be carried over, the mesh would be too large, or no equilibrium is found close to it.

    Examples
    --------
    >>> import turgor as tg
    >>> from turgor.units import kPa, mm
    >>> mesh = tg.mesh(tg.FastPneuNet(chambers=2, length=20 * mm).build(), size=4 * mm)
    >>> rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    >>> model = tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 2 * kPa)])
    >>> new = tg.solutions.remesh(tg.solve(model).states[-1], growth=2)
    >>> len(new.state.model.mesh.cells) > len(mesh.cells), new.error.displacement < 0.1
    (True, True)
    """
    refuse_remeshing(state.model)
    if state.model.mesh.cells.shape[1] == 20:
        raise TurgorError("cells of 20 nodes are cut on a path with remesh = True, which adds their middles first.")
    if not 1 < growth <= 8:
        raise TurgorError(f"growth is {growth:g}; allowed is more than 1 up to 8.")
    new = moved_to(finer_cells(state, growth), state, procedure or Static(), options or EngineOptions())
    if new is None:
        raise TurgorError("no equilibrium was found on the finer cells close to the state; remesh an earlier one.")
    return new


def finer_cells(state: State, growth: float = REMESHING.growth) -> Transfer:
    """Cut the cells of a state where its error is; return what carries fields to them.

    Parameters
    ----------
    state : State
    growth : float
        As in `remesh`.

    Raises
    ------
    TurgorError
        If the finer mesh would be too large.
    """
    refinement = refined(state.model.mesh, error_indicator(state), growth)
    if refinement.mesh.unknown_count > REMESHING.most_unknowns:
        raise TurgorError(
            f"the finer mesh would have {refinement.mesh.unknown_count:,} unknowns; allowed are "
            f"{REMESHING.most_unknowns:,}."
        )
    return Transfer(state.model.mesh, refinement)


def moved_to(transfer: Transfer, state: State, procedure: Procedure, options: EngineOptions) -> Remeshed | None:
    """Carry a state to finer cells and find equilibrium there; None where there is none close to it.

    Parameters
    ----------
    transfer : Transfer
        From `finer_cells`.
    state : State
    procedure : Procedure
    options : EngineOptions
    """
    moved = transferred(state, transfer, replace(state.model, mesh=transfer.mesh))
    try:
        return _equilibrium(state, moved, transfer, procedure, options)
    except (SingularTangentError, np.linalg.LinAlgError):
        return None


def transferred(state: State, transfer: Transfer, model: Model) -> State:
    """Carry a state to a model on finer cells.

    Forces stay at the nodes that both meshes have, so that their sums and moments stay.

    Parameters
    ----------
    state : State
    transfer : Transfer
    model : Model
        That of the state on the mesh of the transfer.

    Returns
    -------
    State
    """
    return replace(
        state,
        model=model,
        displacement=transfer.nodal(state.displacement),
        mean_stress=transfer.mean_stress(state.model, model, state.mean_stress),
        nodal_force=transfer.forces(state.nodal_force),
        touches={name: _touch(touch, transfer) for name, touch in state.touches.items()},
        velocity=None if state.velocity is None else transfer.nodal(state.velocity),
        memory=transfer.memory(state.memory),
    )


def _touch(touch: Touch, transfer: Transfer) -> Touch:
    pressure = transfer.nodal(touch.pressure[:, None])[:, 0]
    return replace(touch, force=transfer.forces(touch.force), pressure=np.maximum(pressure, 0.0))


def _equilibrium(
    state: State, moved: State, transfer: Transfer, procedure: Procedure, options: EngineOptions
) -> Remeshed | None:
    """Find equilibrium at the load factor and the volumes of a state; None where there is none close to it."""
    system = System(moved.model, procedure.controlled(moved.model))
    if state.memory is not None and any(state.memory.friction):
        friction = carried_friction(state, moved, system)
        moved = replace(moved, memory=replace(moved.memory or NO_MEMORY, friction=friction))
    history = system.history(moved.memory, 0.0 if moved.memory is not None else inf)
    unknowns, factor = unknowns_of(system, moved), state.load_factor
    constraint, scalars = _conditions(system, moved, unknowns, history)
    start = constraint.evaluate(unknowns, factor, scalars)
    if start is None:
        return None
    tangent = Tangent(system, options.linear_solver, options.threads, options.iteration)
    settings = NewtonSettings(tolerance=REMESHING.tolerance, max_iterations=REMESHING.iterations)
    begin = Start(unknowns, system.stresses(start), scalars, start)
    result = newton_with_contact(constraint, tangent, begin, factor, settings, silent)
    if not result.converged or result.evaluation is None:
        return None
    error = _error(system, result, (unknowns, scalars), history, factor)
    if error.displacement > REMESHING.most_moved:
        return None
    modes = state.unstable_modes if result.unstable_modes is None else result.unstable_modes
    if (modes or 0) > (state.unstable_modes or 0):
        return None
    new = state_of(system, result.evaluation, modes)
    new = replace(
        moved,
        displacement=new.displacement,
        mean_stress=new.mean_stress,
        nodal_force=new.nodal_force,
        points=new.points,
        unstable_modes=modes,
        pressures={**state.pressures, **new.pressures},
        touches=new.touches,
        memory=new.memory,
    )
    return Remeshed(
        state=new,
        transferred=moved,
        transfer=transfer,
        error=error,
        iterations=result.iterations,
        residual=result.residual,
        restart=Restart.of(system, new),
    )


def _conditions(system: System, state: State, unknowns: Array, history: History) -> tuple[Constraint, Array]:
    """Constraint of the loads of a state, and of the volumes of cavities whose pressures are unknown."""
    if not system.controlled:
        return load_control(system, history=history), np.empty(0)
    chambers = Chambers(system, system.controlled)
    volumes = chambers.volumes(unknowns)
    target = VolumeTarget(chambers, volumes, np.zeros_like(volumes))
    scalars = _scaled_pressures(system, state.pressures)
    return Constraint.of(CavityPressures(system), target, history=history), scalars


def _scaled_pressures(system: System, pressures: Mapping[str, float]) -> Array:
    return np.array([pressures[name] for name in system.controlled]) / system.stress_scale


def _error(
    system: System, result: NewtonResult, before: tuple[Array, Array], history: History, load_factor: float
) -> TransferError:
    assert result.evaluation is not None
    unknowns, scalars = before
    old, new = (system.physical(each)[0] for each in (unknowns, result.evaluation.unknowns))
    size = float(np.linalg.norm(old))
    first, last = (stored_energy(system, each, load_factor, history) for each in (unknowns, result.evaluation.unknowns))
    pressed = np.abs(scalars).max(initial=0.0)
    return TransferError(
        displacement=float(np.linalg.norm(new - old)) / size if size else 0.0,
        energy=(last - first) / first if first else float("nan"),
        pressure=float(np.abs(result.scalars - scalars).max()) / pressed if pressed else 0.0,
    )
