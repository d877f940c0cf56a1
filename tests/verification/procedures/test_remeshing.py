"""Cells that are cut on the way: states are carried over exactly, and the path is one from rest on the new cells.

New cells are pieces of the old ones, so displacement, volume and resultants are carried over to round-off. An elastic
body forgets its path: with cells cut on the way it must reach the state of the path that begins on the last mesh, to
the tolerance of the solve. Rubber that relaxes and softens must come as close as the fit of its internal variables in
each old cell allows: 0.2 %. Friction: 2 % of the pull, because what sticks remembers the cells on which it came to
stick. What a state moves by on new cells is the mesh error that it had. Halving quadratic cells divides that of the
displacements by 8 where they are small enough; 5 is required between one and two cells in a wall.
"""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

import contact_cases
import meshes
import turgor as tg
from problems import MM, NEO_HOOKE, OPTIONS, energy, reaction, rubber, solve
from refused import refused
from turgor.core.meshing.cells import HEXAHEDRON, HEXAHEDRON_20, TETRAHEDRON
from turgor.core.solvers.checks.distortion import node_volume_ratios
from turgor.core.solvers.procedures.procedure import refuse_remeshing
from turgor.core.solvers.remeshing import on_the_way
from turgor.core.solvers.step_reasons import Cause
from turgor.units import kPa, mm

GENT = tg.Material(name="rubber", law=tg.laws.Gent(mu=30 * kPa, Jm=20.0))
RELAXING = replace(
    rubber(NEO_HOOKE),
    viscoelasticity=tg.laws.Prony(g=(0.3,), tau=(0.5,), moduli="instantaneous"),
    stress_softening=tg.laws.Mullins(r=1.4, m=20e3),
)
STEPS = {"first_step": 0.25, "max_step": 0.25, "tolerance": 1e-9}
KINDS = pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])


def hollow_block(kind, inner=3 * mm, outer=10 * mm):
    """One eighth of a cube with a cube of air in it: seven cubes, one cell through each wall."""
    blocks = []
    for corner in product((0, 1), repeat=3):
        if not any(corner):
            continue
        low, high = (np.array([ends[k] for k in corner]) for ends in ((0, inner), (inner, outer)))
        names = {f"{axis}{k}": "outside" if k else f"symmetry_{axis}" for axis, k in zip("xyz", corner, strict=True)}
        if sum(corner) == 1:
            names[f"{'xyz'[corner.index(1)]}0"] = "cavity"
        blocks.append(meshes.Block((1, 1, 1), lambda p, low=low, high=high: low + p * (high - low), names))
    return meshes.glued(blocks, kind=kind)


def ballooned(kind, volumes, **more):
    """The block with a cavity that grows by so many of its volumes."""
    model = tg.Model(hollow_block(kind), {"body": GENT}, [], [])
    return solve(model, tg.VolumeControl(volume=volumes * 8 * (3 * mm) ** 3, **more), throw=False)


def thin_roof(remesh):
    """A quarter of a block of 16 mm with a cavity of 8 mm under a roof of 2 mm, one cell thick, that balloons."""
    lines = [np.array([0, 2, 4, 8]) * mm, np.array([0, 2, 4, 8]) * mm, np.array([0, 4, 8, 10]) * mm]

    def solid(cube):
        return not (cube[0] < 2 and cube[1] < 2 and cube[2] == 1)

    blocks = []
    for cube in filter(solid, product(range(3), repeat=3)):
        low, high = (np.array([line[k + end] for line, k in zip(lines, cube, strict=True)]) for end in (0, 1))
        names = {}
        for a, end in product(range(3), (0, 1)):
            neighbor = tuple(k + (2 * end - 1) * (b == a) for b, k in enumerate(cube))
            if neighbor[a] < 0:
                names[f"{'xyz'[a]}0"] = ("symmetry_x", "symmetry_y", "fixed")[a]
            elif neighbor[a] > 2 or not solid(neighbor):
                names[f"{'xyz'[a]}{end}"] = "outside" if neighbor[a] > 2 else "cavity"
        blocks.append(meshes.Block((1, 1, 1), lambda p, low=low, high=high: low + p * (high - low), names))
    material = tg.Material(name="rubber", law=tg.laws.Gent(mu=30 * kPa, Jm=80.0))
    model = tg.Model(meshes.glued(blocks, kind=HEXAHEDRON), {"body": material}, [tg.Fixed("fixed")], [])
    return solve(model, tg.VolumeControl(volume=160 * (4 * mm) ** 3, remesh=remesh), throw=False)


def sphere(cells=1, material=None, pressure=30e3, kind=HEXAHEDRON):
    """A thick sphere under pressure."""
    mesh = meshes.sphere_octant(10 * MM, 15 * MM, cells, cells, kind=kind)
    return tg.Model(mesh, {"body": material or rubber(NEO_HOOKE)}, [], [tg.Pressure("cavity", pressure)])


@pytest.fixture
def degraded_at_half(monkeypatch):
    """Call the cells of a first mesh degraded from load factor 0.5 on, and cut few."""

    def call(model):
        count = len(model.mesh.cells)
        share = lambda state: float(len(state.model.mesh.cells) == count and state.load_factor >= 0.5)  # noqa: E731
        monkeypatch.setattr(on_the_way, "degraded_volume", share)
        return model

    return call


def cut_at(solution):
    """Load factors at which cells were cut."""
    return [step.load_factor for step in solution.steps if step.cause is Cause.REMESHED]


def same_as_from_the_start(solution, within):
    """The path on the last mesh from the start; the last states agree to a share of the displacement."""
    again = solve(solution.model, replace(solution.procedure, remesh=False))
    one, other = (each.states[-1].displacement for each in (solution, again))
    apart = float(np.linalg.norm(one - other) / np.linalg.norm(other))
    assert apart < within
    return again, apart


@KINDS
def test_a_state_is_carried_over_exactly(kind, record_verification):
    solution = ballooned(kind, 2.0, max_step=0.5, first_step=0.5)
    state = solution.states[-1]
    new = tg.solutions.remesh(state, solution.procedure, growth=2.0, options=OPTIONS)
    there = new.transferred
    assert len(there.model.mesh.cells) > len(state.model.mesh.cells)
    before, after = tg.cavity_volume(state), tg.cavity_volume(there)
    claim = f"cavity of a state carried over to finer cells of {kind.nodes} nodes, over that before"
    record_verification(claim, "exact", 1.0, after / before, "1e-12")
    assert after == pytest.approx(before, rel=1e-12)
    assert tg.cavity_volume(new.state) == pytest.approx(before, rel=1e-6)  # the procedure prescribes it
    for face in ("symmetry_x", "symmetry_y", "symmetry_z"):
        assert reaction(there, face) == pytest.approx(reaction(state, face), abs=1e-9)
    assert energy(there) == pytest.approx(energy(state), rel=5e-2)  # other integration points
    assert new.error.energy < 0  # finer cells are softer


def test_the_error_falls_with_the_cells(record_verification):
    errors = []
    for cells in (1, 2):
        state = solve(sphere(cells), tg.Static(first_step=1.0, max_step=1.0)).states[-1]
        errors.append(tg.solutions.remesh(state, growth=8.0, options=OPTIONS).error.displacement)
    ratio = errors[0] / errors[1]
    claim = "change of displacement on halved cells: of one cell in a wall over that of two"
    record_verification(claim, "8 in the limit", 8, ratio, "> 5")
    assert ratio > 5


def test_a_ballooned_block_goes_on_with_new_cells(record_verification):
    solution = ballooned(HEXAHEDRON, 30.0, remesh=True)
    assert solution.converged and {id(state.model) for state in solution.states} == {id(solution.model)}
    cut = cut_at(solution)
    notes = [each.message for each in solution.findings if each.code == "N07"]
    assert len(cut) == len(notes) >= 1
    assert notes[0].startswith(f"New cells at load factor {cut[0]:.4g}: 7 became")
    response = tg.measure(solution, tg.cavity_volume, mesh_error=False)
    rising = np.diff(response["cavity_volume"])
    assert len(response) == len(solution.states) and (rising > 0).all()
    again, _ = same_as_from_the_start(solution, 1e-4)
    result, expected = (each.states[-1].pressures["cavity"] / kPa for each in (solution, again))
    claim = "ballooned block whose cells were cut on the way, against the path on the last ones: pressure [kPa]"
    record_verification(claim, "the same problem", expected, result, "1e-5")
    assert result == pytest.approx(expected, rel=1e-5)


@pytest.mark.slow  # 40 s: the cells of the second path are many
def test_a_block_that_stops_on_its_cells_goes_on():
    solution = thin_roof(remesh=False)
    assert solution.status is tg.Status.LIMIT_POINT and solution.states[-1].load_factor < 0.9
    solution = thin_roof(remesh=True)
    assert solution.converged
    assert node_volume_ratios(solution.states[-1]).min() > -0.2  # -1 where it stopped


def test_rubber_remembers_on_new_cells(degraded_at_half, record_verification):
    model = degraded_at_half(sphere(1, RELAXING))
    solution = solve(model, tg.Static(duration=1.0, remesh=True, **STEPS))
    assert cut_at(solution) == [0.5] and len(solution.model.mesh.cells) > len(model.mesh.cells)
    assert [state.time for state in solution.states] == [0.0, 0.25, 0.5, 0.75, 1.0]
    _, apart = same_as_from_the_start(solution, 2e-3)
    claim = "relaxing, softening sphere whose cells were cut at half the load, against the path on the last ones"
    record_verification(claim, "the same problem", 0.0, apart, "2e-3")
    assert apart > 0  # the fit is not exact


def test_contact_is_rebuilt_on_new_cells(degraded_at_half):
    plate = contact_cases.pushed(tg.obstacles.Plane(point=(0, 0, 5 * MM), normal=(0, 0, -1)), (0, 0, -0.5))
    model = degraded_at_half(contact_cases.standing(contact_cases.block((1, 1, 1)), plate))
    solution = solve(model, tg.Static(remesh=True, **STEPS))
    cut = cut_at(solution)
    assert len(cut) == 1 and cut[0] >= 0.5 and len(solution.model.mesh.cells) > 1
    assert (np.diff([state.load_factor for state in solution.states]) > 0).all()
    again, _ = same_as_from_the_start(solution, 1e-5)
    forces = [contact_cases.push(each.states[-1].touches["plate"]) for each in (solution, again)]
    assert forces[0] == pytest.approx(forces[1], rel=1e-4, abs=1e-6)


def test_cells_of_20_nodes_get_middles_that_follow(degraded_at_half, record_verification):
    """The run goes on with 27 nodes whose middles follow: it starts within a percent of the one on 20 nodes."""
    model = degraded_at_half(sphere(1, kind=HEXAHEDRON_20))
    whole, solution = solve(model, tg.Static(**STEPS)), solve(model, tg.Static(remesh=True, **STEPS))
    assert cut_at(solution) == [0.5] and solution.model.mesh.serendipity
    same_as_from_the_start(solution, 1e-5)
    assert len(solution.model.mesh.cells) > len(model.mesh.cells)
    volumes = [tg.cavity_volume(each.states[1]) for each in (whole, solution)]
    claim = "sphere of 20-node cells before they are cut: volume of its cavity over that without remeshing"
    record_verification(claim, "the same problem", 1.0, volumes[1] / volumes[0], "1 %")
    assert volumes[1] == pytest.approx(volumes[0], rel=1e-2)


@pytest.mark.parametrize("way", [0.1 * mm, 0.5 * mm], ids=["sticks", "slides"])
def test_friction_is_carried_over(way, degraded_at_half, record_verification):
    path = ((0, (0, 0, 0)), (0.25, (0, 0, -0.2 * mm)), (1, (way, 0, -0.2 * mm)))
    plane = tg.obstacles.Plane(point=(0, 0, 5 * MM), normal=(0, 0, -1))
    plate = tg.obstacles.Obstacle(name="plate", shape=plane, friction=0.3, path=path, elastic_slip=5e-6)
    model = degraded_at_half(contact_cases.standing(contact_cases.block((2, 2, 2)), plate))
    solution = solve(model, tg.Static(remesh=True, **STEPS))
    assert cut_at(solution) == [0.5]
    before, state = (each.states[2] for each in (solve(model, tg.Static(**STEPS)), solution))
    again, _ = same_as_from_the_start(solution, 1e-2)  # what sticks remembers the cells on which it came to stick
    forces = [contact_cases.push(each.touches["plate"])[0] for each in (before, state, *_ends(solution, again))]
    claim = "block dragged by a plate that {}, cells cut at half the way, against the path on the last ones: pull [N]"
    record_verification(claim.format("sticks" if way < 0.3 * mm else "slides"), "the same", *forces[:1:-1], "2 %")
    assert forces[1] == pytest.approx(forces[0], rel=0.06)  # the mesh error of two cells
    assert forces[2] == pytest.approx(forces[3], rel=2e-2)


def _ends(*solutions):
    return [each.states[-1] for each in solutions]


@pytest.mark.parametrize(("ended_at", "saved"), [(0.75, 3), (1.0, 4)])
def test_a_run_that_was_ended_goes_on(ended_at, saved, degraded_at_half, tmp_path):
    model = degraded_at_half(sphere(1))
    procedure = tg.Static(remesh=True, **STEPS)
    whole = solve(model, procedure)

    def end(_iteration, state):
        if state is not None and state.load_factor == ended_at:
            raise KeyboardInterrupt

    folder = tmp_path / "path"
    ended = solve(model, procedure, folder=folder, progress=end, throw=False)
    assert ended.status is tg.Status.INTERRUPTED
    so_far = tg.load(folder)
    assert [state.load_factor for state in so_far.states] == [0.0, 0.25, 0.5, 0.75][:saved]
    resumed = tg.resume(folder)
    assert resumed.steps[-1].load_factor == 1 and len(resumed.states) == len(whole.states)
    for one, other in zip(resumed.states, whole.states, strict=True):
        assert one.displacement == pytest.approx(other.displacement, abs=1e-12)


@pytest.mark.parametrize("kind", ["wire", "tendon"])
def test_cables_remember_on_new_cells(kind):
    """A wire that was heated and is cold again stays austenite; a cable with friction stays tight beyond its guides."""
    way, history = [(x * mm, 4 * mm, 8 * mm) for x in (0, 20, 40)], ((0, 0), (0.5, 1), (1, 0.4))
    if kind == "wire":
        alloy = {"alloy": "nitinol-brinson-1993", "strain": 0.01, "temperature": "90 °C"}
        load = tg.loads.ShapeMemoryWire(through=way, diameter="0.05 mm", history=history, **alloy)
    else:
        load = tg.loads.Tendon(through=way, tension="0.2 N", friction=0.5, history=history)
    mesh = meshes.box((40 * mm, 8 * mm, 8 * mm), (4, 1, 1), kind=HEXAHEDRON)
    state = solve(tg.Model(mesh, {"body": rubber(NEO_HOOKE)}, [tg.Fixed("x0")], [load]), tg.Static()).states[-1]
    new = tg.solutions.remesh(state, growth=2.0, options=OPTIONS)
    before, there, after = (tg.measures.cable_results(each)[0] for each in (state, new.transferred, new.state))
    assert there.phases == before.phases
    assert there.tension == pytest.approx(before.tension, rel=1e-9)
    assert after.tension == pytest.approx(before.tension, rel=0.2)  # the rubber gives way more around the ends


def test_what_cannot_be_carried_over_is_refused():
    part = meshes.box((10 * mm, 10 * mm, 10 * mm), (1, 1, 1))
    for near, moves in (((10 * mm, 10 * mm, 10 * mm), False), ((9 * mm, 9 * mm, 10 * mm), True)):
        push = tg.loads.Force(tg.supports.NodesAt("corner", near=near), (0, 0, -1e-3))
        cube = tg.Model(part, {"body": rubber(NEO_HOOKE)}, ["z0"], [push])
        if moves:
            with refused("procedure.remesh", "'corner'"):
                refuse_remeshing(cube)
        else:
            refuse_remeshing(cube)
    with refused("remesh", "without stages"):
        tg.Stages([tg.Stage("fill", tg.Static(remesh=True))])
    state = solve(sphere(1), tg.Static(first_step=1.0, max_step=1.0)).states[-1]
    with refused("growth is 9", "up to 8"):
        tg.solutions.remesh(state, growth=9)
