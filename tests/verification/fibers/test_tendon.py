"""Tendons: a bar with a cable along one side bends to a constant curvature; friction; a cable that is drawn in.

Problem: a bar of 100 × 4 × 4 mm, clamped, with 10 guides along the middle of its upper side, 2 mm from the axis.
Exact for a cable that touches the side everywhere: the bar carries −T along its axis and T e as a moment at every
section, however far it bends, so that the angle is φ = T e L / EI; with friction the tension falls with the turn, and
the angle is ln(1 + μ φ) / μ (thin bar, no stretch of the axis). Between guides at a distance d the cable is a chord of
the inner arc, on average d² / 12R farther from the axis: φ = T e L / (EI − T d² / 12). The angle is read at 75 mm,
between two guides, because the rubber gives way where the cable presses and ends.
Friction that turns round: a cable over the corner of three guides. Pulled, the tension beyond it is T exp(−μ θ).
Let go, it stays as long as the motor's is above exp(−2 μ θ) of the largest one, but for the elastic slip; then it is
T exp(μ θ).
Tolerance: 2 %: the axis is 1 % shorter. A cable that is drawn in and one with the same tension: 1e-5; a half model and
the whole: 1e-6.
"""

from functools import lru_cache

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.results.fields.cables import cables_with_tension
from turgor.core.results.fields.state_fields import StateFields

MM = problems.MM
LENGTH, SIDE = 100 * MM, 4 * MM
STIFFNESS = 0.72 * problems.MPA * SIDE**4 / 12
TENSION = 1.4 * STIFFNESS / (LENGTH * SIDE / 2)  # 1.4 rad, 80 degrees
CELLS = 10
GUIDES = tuple((x, 0.0, SIDE / 2) for x in np.linspace(0, LENGTH, CELLS + 1))


def bar(half=True, **cable):
    """The bar along x; its middle plane y = 0 is a mirror plane of the half."""
    width = SIDE / 2 if half else SIDE

    def place(points):
        return points - np.array([0, 0 if half else SIDE / 2, SIDE / 2])

    mesh = meshes.box((LENGTH, width, SIDE), (CELLS, 1 if half else 2, 2), place, kind=HEXAHEDRON)
    if half:
        faces = {("symmetry_y" if name == "y0" else name): sides for name, sides in mesh.faces.items()}
        mesh = tg.Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)
    loads = [tg.loads.Tendon(through=GUIDES, **cable)]
    return problems.one_material(mesh, problems.NEO_HOOKE, supports=[tg.Fixed("x0")], loads=loads)


@lru_cache
def state_with(half=True, **cable):
    return problems.solve(bar(half, **cable)).states[-1]


def angle(state):
    """By which the section at 75 mm has turned [rad]."""
    points = problems.current(state)
    top, low = (points[meshes.node_at(state.model.mesh, (0.75 * LENGTH, 0, z))] for z in (SIDE / 2, -SIDE / 2))
    return float(np.arctan2(*(low - top)[[0, 2]] * [1, -1]))


def cable_length(state):
    nodes = [meshes.node_at(state.model.mesh, point) for point in GUIDES]
    return float(np.linalg.norm(np.diff(problems.current(state)[nodes], axis=0), axis=1).sum())


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_a_bar_bends_as_its_tendon_pulls(friction, record_verification):
    straight = TENSION * SIDE / 2 * 0.75 * LENGTH / (STIFFNESS - TENSION * (LENGTH / CELLS) ** 2 / 12)
    expected = np.log(1 + friction * straight) / friction if friction else straight
    got = angle(state_with(tension=TENSION, friction=friction))
    record_verification(
        claim=f"bar with a tendon, friction {friction:g}: angle at 75 mm [rad]",
        source="exact, thin bar",
        expected=expected,
        got=got,
        tolerance="2 %",
    )
    assert got == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_a_cable_that_is_drawn_in_has_the_tension_of_its_stretch(friction):
    pulled, stiffness = state_with(tension=TENSION, friction=friction), 1e3
    state = state_with(tension=TENSION, friction=friction)
    nodes = [meshes.node_at(state.model.mesh, point) for point in GUIDES]
    chords = np.diff(problems.current(state)[nodes], axis=0)
    directions = chords / np.linalg.norm(chords, axis=1)[:, None]
    turns = np.arccos(np.clip((directions[1:] * directions[:-1]).sum(axis=1), -1, 1))
    left = np.exp(-friction * np.append(0, np.cumsum(turns)))
    stretch = TENSION * left.mean() / stiffness
    drawn = state_with(pull=LENGTH - cable_length(pulled) + stretch, cable_stiffness=stiffness, friction=friction)
    assert angle(drawn) == pytest.approx(angle(pulled), rel=1e-5)


CORNER = ((0, 5 * MM, 10 * MM), (10 * MM, 5 * MM, 10 * MM), (10 * MM, 10 * MM, 10 * MM))
UP_AND_DOWN = ((0, 0), (0.4, 1), (0.6, 0.6), (1, 0.2))


@pytest.mark.parametrize(
    "drive", [{"tension": 2.0}, {"pull": 3 * MM, "cable_stiffness": 2e3}], ids=["tension", "length drawn in"]
)
def test_friction_turns_round_where_the_motor_lets_go(drive, record_verification):
    cable = tg.loads.Tendon(through=CORNER, friction=0.3, history=UP_AND_DOWN, **drive)
    solution = problems.solve(_block([cable]), tg.Static(at=[0.2, 0.4, 0.6, 1.0]))
    assert solution.complete
    got = {round(state.load_factor, 6): _corner(state) for state in solution.states}
    for at, sign in ((0.2, -1), (0.4, -1), (1.0, 1)):
        first, second, turn = got[at]
        record_verification(
            claim=f"tension beyond a corner over that before it, load factor {at} of {', '.join(drive)}",
            source="Euler and Eytelwein", expected=float(np.exp(sign * 0.3 * turn)), got=second / first,
            tolerance="1e-6",
        )  # fmt: skip
        assert second / first == pytest.approx(np.exp(sign * 0.3 * turn), rel=1e-6)
    last = solution.states[-1]
    assert tg.measures.cable_end_tension(last) == pytest.approx(_corner(last)[1])
    (_, pulled, turn), (first, stuck, _) = got[0.4], got[0.6]
    if "tension" in drive:
        assert np.exp(-0.3 * turn) < stuck / first < np.exp(0.3 * turn)
        assert 0.9 * pulled < stuck < pulled  # the corner has slipped elastically


def _block(loads):
    mesh = meshes.box((20 * MM, 10 * MM, 10 * MM), (2, 2, 1), kind=HEXAHEDRON)
    return problems.one_material(mesh, problems.NEO_HOOKE, supports=[tg.Fixed("x0")], loads=loads)


def _corner(state):
    """Tension before and beyond the corner [N], and the turn there."""
    (result,) = tg.measures.cable_results(state)
    before, after = np.diff(result.guides, axis=0)
    turn = np.arccos(before @ after / np.linalg.norm(before) / np.linalg.norm(after))
    return (*(float(each) for each in result.tension), float(turn))


@pytest.mark.parametrize("drives", [({"tension": 2.0}, {"tension": 0.9}), ({"pull": 3 * MM}, {"pull": 1.35 * MM})])
def test_a_stage_lets_a_cable_go(drives):
    """A cable that is let go in a stage of its own is one cable, and its friction goes on."""
    stiff = {"cable_stiffness": 2e3} if "pull" in drives[0] else {}
    cables = [tg.loads.Tendon(through=CORNER, friction=0.3, **drive, **stiff) for drive in drives]
    stages = tg.Stages([tg.Stage("pull", loads=cables[:1]), tg.Stage("let go", loads=cables[1:])])
    first, second, turn = _corner(problems.solve(_block([]), stages).states[-1])
    back = ((0, 0), (0.5, 1), (1, 0.45))
    once = tg.loads.Tendon(through=CORNER, friction=0.3, history=back, **drives[0], **stiff)
    at_once = _corner(problems.solve(_block([once])).states[-1])
    assert (first, second, turn) == pytest.approx(at_once, rel=1e-3)
    assert second > 1.1 * first * np.exp(-0.3 * turn)
    assert first == pytest.approx(drives[1].get("tension", first))


def test_results_show_the_cable_with_its_tension():
    state = state_with(tension=TENSION, friction=0.3)
    ((guides, tension),) = cables_with_tension(StateFields(state))
    nodes = [meshes.node_at(state.model.mesh, point) for point in GUIDES]
    assert guides == pytest.approx(problems.current(state)[nodes], abs=1e-9)
    assert tension[0] == pytest.approx(TENSION)
    chords = np.diff(guides, axis=0)
    first, last = chords[0], chords[-1]
    turned = np.arccos(first @ last / np.linalg.norm(first) / np.linalg.norm(last))
    assert tension[-1] == pytest.approx(TENSION * np.exp(-0.3 * turned), rel=1e-6)


def test_measures_say_what_the_motor_does():
    state = state_with(tension=TENSION, friction=0.3)
    assert tg.measures.cable_tension(state) == pytest.approx(TENSION)
    assert tg.measures.cable_travel(state) == pytest.approx(LENGTH - cable_length(state))
    plain = problems.solve(problems.one_material(state.model.mesh, problems.NEO_HOOKE, supports=["x0"]))
    with pytest.raises(tg.TurgorError) as error:
        tg.measures.cable_travel(plain.states[-1])
    assert "no cable" in str(error.value)


def test_a_half_model_carries_half_of_the_cable():
    small = {"tension": 0.2 * TENSION}
    assert angle(state_with(half=False, **small)) == pytest.approx(angle(state_with(**small)), rel=1e-6)


def test_a_cable_does_not_push():
    model = bar(tension=TENSION)
    force = tg.Traction("x1", (-100.0, 0, 0))  # the bar becomes 14 µm shorter
    slack = tg.loads.Tendon(through=GUIDES, pull=5e-6, cable_stiffness=1e3)
    tight = tg.loads.Tendon(through=GUIDES, pull=50e-6, cable_stiffness=1e3)
    moved = [
        problems.solve(tg.Model(model.mesh, model.materials, ["x0"], [force, *more])).states[-1].displacement
        for more in ([], [slack], [tight])
    ]
    assert moved[1] == pytest.approx(moved[0], abs=1e-10)
    assert np.abs(moved[2] - moved[0]).max() > 1e-4


@pytest.mark.parametrize(
    ("cable", "facts"),
    [
        ({"tension": 1.0, "pull": 1e-3}, ["either tension or pull"]),
        ({}, ["either tension or pull"]),
        ({"pull": 1e-3}, ["stiffness"]),
        ({"tension": -1.0}, ["tension is -1", "above 0"]),
        ({"tension": 1.0, "friction": 3.0}, ["friction is 3", "0 to 2"]),
        ({"tension": 1.0, "through": ((0, 0, 0.002),)}, ["1 points", "two"]),
        ({"tension": 1.0, "through": ((0, 0, 0.002), (0, 0, 0.002))}, ["points 1 and 2", "coincide"]),
        ({"tension": 1.0, "through": ((0, 0, 0.002), (0.05, 0, 0.01))}, ["point 2", "8 mm away"]),
    ],
)
def test_what_is_no_cable_is_refused(cable, facts):
    mesh = bar(tension=1.0).mesh

    def pulled():
        load = tg.loads.Tendon(**{"through": GUIDES, **cable})
        problems.solve(problems.one_material(mesh, problems.NEO_HOOKE, supports=["x0"], loads=[load]))

    with pytest.raises(tg.TurgorError) as error:
        pulled()
    for fact in facts:
        assert fact in str(error.value)


def test_a_cable_that_leaves_a_mirror_plane_is_refused():
    load = tg.loads.Tendon(through=((0, 0, SIDE / 2), (LENGTH, SIDE / 4, SIDE / 2)), tension=1.0)
    model = bar(half=True, tension=1.0)
    with pytest.raises(tg.TurgorError) as error:
        problems.solve(tg.Model(model.mesh, model.materials, ["x0"], [load]))
    for fact in ("normal to y", "point 2"):
        assert fact in str(error.value)
