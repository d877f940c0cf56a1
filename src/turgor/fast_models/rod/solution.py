"""Solution of rods: states along a path, shapes of the rods, and the response."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.fast_models.rod.elements import stored_energy
from turgor.fast_models.rod.frames import logarithm
from turgor.fast_models.rod.layout import mass_matrices, nodal_mass
from turgor.fast_models.rod.model import RodModel
from turgor.fast_models.rod.state import RodState
from turgor.fast_models.rod.system import RodSystem
from turgor.foundation.errors import NotSolved
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

Array = NDArray[np.float64]


class RodError(NotSolved):
    """A path of rods that ended early; `solution` holds the states so far."""

    def __init__(self, message: str, solution: "RodSolution") -> None:
        super().__init__(message)
        self.solution = solution


@dataclass(frozen=True, slots=True, eq=False)
class RodShape:
    """A rod in one state: its sections at stations, and strains and forces in the middle between them.

    Parameters
    ----------
    arc : (m + 1,) array [m]
        Place of the sections along the axis at rest.
    position : (m + 1, 3) array [m]
        Where the axis passes through them.
    frames : (m + 1, 3, 3) array
        Their axes as columns: along the rod, y and z of the section.
    middle : (m,) array [m]
        Places along the axis at rest to which the following belong.
    strain : (m, 6) array [-, 1/m]
        Stretch, shear in y and z, twist, curvature about y and z; the stretch of an unloaded straight rod is 1.
    force : (m, 6) array [N, N m]
        Net forces and moments on the sections, in their axes: what balances the loads.
    wall_force : (m, 6) array [N, N m]
        What the rubber carries: net forces and what the pressure takes.
    """

    arc: Array
    position: Array
    frames: Array
    middle: Array
    strain: Array
    force: Array
    wall_force: Array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RodSolution:
    """States of rods along a path or in time, and how the solve ended.

    Parameters
    ----------
    model : RodModel
    states : tuple of RodState
        The first one is rest, or where the motion began.
    status : str
        ``"converged"``, or why the path ended early.
    message : str
    iterations : int
        Of Newton's method, over the whole path.
    stable : tuple of bool or None
        Whether each state is a minimum of energy; None where the loads have none.
    time : (n,) array [s] or None
        Times of the states of a motion.
    """

    model: RodModel
    states: tuple[RodState, ...]
    status: str
    message: str
    iterations: int
    stable: tuple[bool | None, ...] = ()
    time: Array | None = None

    def __repr__(self) -> str:
        return f"RodSolution({len(self.states)} states, {self.status}: {self.message})"

    @property
    def load_factors(self) -> Array:
        """Load factors of the states, (n,)."""
        return np.array([state.load_factor for state in self.states])

    @property
    def tip(self) -> Array:
        """Positions of the plate at which the last rod ends, (n, 3) [m]."""
        return self.plate_positions(self.model.rods[-1].end)

    def plate_positions(self, plate: str) -> Array:
        """Return the positions of a plate in all states, (n, 3) [m]."""
        self.model.plate(plate)
        node = self.model.plate_names.index(plate)
        return np.array([state.position[node] for state in self.states])

    def plate_axes(self, plate: str) -> Array:
        """Return the axes of a plate in all states as columns, (n, 3, 3)."""
        self.model.plate(plate)
        node = self.model.plate_names.index(plate)
        return np.array([state.turn[node] for state in self.states])

    def shape(self, index: int = -1, rod: str | None = None) -> RodShape:
        """Return a rod in one state.

        Parameters
        ----------
        index : int
            Which state; the last one by default.
        rod : str or None
            Which rod; the first one by default.

        Returns
        -------
        RodShape
        """
        return shapes_of(RodSystem(self.model), self.states[index])[
            0 if rod is None else self.model.rods.index(self.model.rod(rod))
        ]

    def reaction(self, plate: str, index: int = -1) -> Array:
        """Return force and moment that a fixed plate takes from its support, (6,) [N, N m], in the axes of space."""
        self.model.plate(plate)
        node = self.model.plate_names.index(plate)
        state = self.states[index]
        wrench = RodSystem(self.model).evaluate(state).residual[node]
        return np.concatenate([state.turn[node] @ wrench[:3], state.turn[node] @ wrench[3:]])

    def response(self, plate: str | None = None) -> Response:
        """Return the response along the path: what drives it, then motion of a plate, curvature and energies.

        Parameters
        ----------
        plate : str or None
            Whose motion; by default the plate at which the last rod ends.

        Returns
        -------
        Response
            Tip displacement, its components, and bending angle as `turgor.measures` define them; `curvature` is the
            mean rotation of the sections by bending over the length of the deformed axis, for the rods on the way to
            the plate; `strain_energy` that of all rods.
        """
        return _response(self, self.model.rods[-1].end if plate is None else plate)


def shapes_of(system: RodSystem, state: RodState) -> tuple[RodShape, ...]:
    """Return the shapes of all rods in a state."""
    layout = system.layout
    turn = state.turn[layout.ends] @ layout.end_turn
    place = state.position[layout.ends] + (state.turn[layout.ends] @ layout.end_position[..., None])[..., 0]
    back = np.swapaxes(turn[:, 0], 1, 2)
    twist = logarithm(back @ turn[:, 1], (back @ (place[:, 1] - place[:, 0])[:, :, None])[:, :, 0])
    strain = twist / layout.length[:, None]
    wall = state.force + system.pressure_wrench(state.load_factor)
    shapes = []
    for k, rod in enumerate(system.model.rods):
        own = layout.rod == k
        arc = np.linspace(0.0, rod.length, rod.elements + 1)
        shapes.append(
            RodShape(
                arc=arc,
                position=np.concatenate([place[own, 0], place[own, 1][-1:]]),
                frames=np.concatenate([turn[own, 0], turn[own, 1][-1:]]),
                middle=0.5 * (arc[1:] + arc[:-1]),
                strain=strain[own],
                force=state.force[own],
                wall_force=wall[own],
            )
        )
    return tuple(shapes)


def strain_energy(system: RodSystem, state: RodState) -> float:
    """Return the energy that the rubber of all rods stores, with the linear law of the section [J]."""
    strain = np.concatenate([shape.strain for shape in shapes_of(system, state)])
    wall = state.force + system.pressure_wrench(state.load_factor)
    return float(stored_energy(system.law(state.load_factor), strain, state.force, wall).sum())


def kinetic_energy(system: RodSystem, state: RodState) -> float:
    """Return the kinetic energy of all rods and plates [J]."""
    masses = mass_matrices(*nodal_mass(system.model, system.layout))
    velocity = state.velocity
    return 0.0 if velocity is None else 0.5 * float(np.einsum("ni,nij,nj->", velocity, masses, velocity))


def _response(solution: RodSolution, plate: str) -> Response:
    system = RodSystem(solution.model)
    chain = _chain(solution.model, plate)
    shapes = [shapes_of(system, state) for state in solution.states]
    moved = solution.plate_positions(plate) - system.layout.position[solution.model.plate_names.index(plate)]
    columns = [Column("load_factor", "", solution.load_factors)]
    if solution.time is not None:
        columns.append(Column("time", "s", solution.time))
    columns += _pressures(solution, system)
    columns.append(Column("tip_displacement", "mm", np.linalg.norm(moved, axis=1)))
    columns += [Column(f"tip_displacement_{axis}", "mm", moved[:, k]) for k, axis in enumerate("xyz")]
    columns.append(Column("bending_angle", "deg", np.array([_angle([each[k] for k in chain]) for each in shapes])))
    columns.append(Column("curvature", "1/m", np.array([_curvature([each[k] for k in chain]) for each in shapes])))
    columns.append(Column("strain_energy", "mJ", np.array([strain_energy(system, s) for s in solution.states])))
    if solution.time is not None:
        columns.append(Column("kinetic_energy", "mJ", np.array([kinetic_energy(system, s) for s in solution.states])))
    source = Source(text="turgor, Cosserat rod", detail=f"{len(system.layout.ends)} elements")
    return Response(columns=tuple(columns), source=source, status=solution.status, message=solution.message)


def _pressures(solution: RodSolution, system: RodSystem) -> list[Column]:
    """One column for each chamber that is loaded; rods of one name of a chamber share it where their values agree."""
    every = [system.pressures(state.load_factor) for state in solution.states]
    pressures: dict[str, Array] = {}
    for k, rod in enumerate(solution.model.rods):
        for chamber in rod.section.chambers:
            values = np.array([own[k][chamber.name] for own in every])
            known = pressures.get(chamber.name)
            same = known is None or np.array_equal(known, values)
            pressures[chamber.name if same else f"{rod.name}_{chamber.name}"] = values
    loaded = {name: values for name, values in pressures.items() if values.any()}
    return [
        Column("pressure" if len(loaded) == 1 else f"pressure_in_{name}", "kPa", values)
        for name, values in loaded.items()
    ]


def _chain(model: RodModel, plate: str) -> list[int]:
    """Rods on the way to a plate, from its beginning; of several that end there, the first."""
    chain: list[int] = []
    while True:
        ending = [k for k, rod in enumerate(model.rods) if rod.end == plate and k not in chain]
        if not ending:
            return chain[::-1]
        chain.append(ending[0])
        plate = model.rods[ending[0]].start


def _angle(shapes: list[RodShape]) -> float:
    """Rotation of the sections in the x-z plane from the first to the last, positive downwards [rad]."""
    axes = np.concatenate([shape.frames[:, :, 0] for shape in shapes]) if shapes else np.eye(3)[:1]
    angles = np.unwrap(np.arctan2(-axes[:, 2], axes[:, 0]))
    return float(angles[-1] - angles[0])


def _curvature(shapes: list[RodShape]) -> float:
    """Mean rotation by bending over the deformed length [1/m]."""
    bent = sum(float(np.linalg.norm(s.strain[:, 4:], axis=1) @ np.diff(s.arc)) for s in shapes)
    long = sum(float(np.linalg.norm(s.strain[:, :3], axis=1) @ np.diff(s.arc)) for s in shapes)
    return bent / long if long else 0.0
