"""Stages: a sequence of procedures ends where the same loads end together, and keeps what it sealed.

Problem: a hollow box of rubber, 30 mm wide with a void of 10 mm, that stands clamped; under weight and pressure in
turn; filled, sealed and pressed by a plate; inflated, sealed and taken where the air is thinner; held and let go.
Exact: the end of an elastic body does not depend on the order of its loads; a sealed liquid keeps its volume; a sealed
ideal gas keeps p V; a body in equilibrium stays at rest. Source: statics, ideal gas. Tolerance: 1e-6, a thousand times
that of Newton's method.
"""

import dataclasses

import numpy as np
import pytest

import contact_cases
import meshes
import problems
import turgor as tg
from problems import MM
from refused import refused
from turgor.core.engine.faces import surfaces
from turgor.core.model.contact import Contact
from turgor.core.model.continued_model import continued, with_loads
from turgor.core.model.obstacles import Obstacle, Plane
from turgor.core.model.supports import Shift
from turgor.core.solvers.pressures import pressures_of
from turgor.views.report import describe_procedure

KPA, ML = 1e3, 1e-6
STEPS = {"first_step": 0.25, "max_step": 0.5, "tolerance": 1e-9}
STATIC = tg.Static(**STEPS)
WEIGHT = tg.Gravity((0, 0, -1), 50.0)
AIR = tg.Pressure("cavity", 20 * KPA)
ABOVE = Plane(point=(0, 0, 31 * MM), normal=(0, 0, -1))
DOWN = (0.0, 0.0, -3 * MM)


def box(loads=(), friction=None, path=(), supports=()):
    """The model; with a plate above if there is friction to state."""
    mesh = meshes.hollow_box(3)
    mesh = meshes.with_points(mesh, mesh.points * 30 * MM)
    plate = Obstacle(name="plate", shape=ABOVE, friction=friction or 0.0, path=path)
    contact = Contact(self_contact=False, obstacles=() if friction is None else (plate,))
    materials = {"body": problems.rubber(problems.NEO_HOOKE, density=1100.0)}
    return tg.Model(mesh, materials, [tg.Fixed("z0"), *supports], loads, contact=contact)


def volume(state):
    """Volume of the void [m³]."""
    mesh = state.model.mesh
    return -surfaces.enclosed_volume(mesh.points + state.displacement, mesh.face("cavity"))


def in_turn(model, *stages, **more):
    return problems.solve(model, tg.Stages(stages), **more)


def named(solution, name):
    """States of one stage."""
    return [state for state in solution.states if state.stage == name]


def test_the_order_of_loads_does_not_matter(record_verification):
    together = problems.solve(box([WEIGHT, AIR]), STATIC).states[-1]
    first = in_turn(box([WEIGHT]), tg.Stage("weight", STATIC), tg.Stage("pressure", STATIC, loads=[AIR]))
    last = in_turn(
        box(),
        tg.Stage("pressure", STATIC, loads=[tg.Pressure("cavity", 35 * KPA)]),
        tg.Stage("sideways", STATIC, loads=[tg.Gravity((1, 0, 0), 80.0), tg.Traction("x1", (0, 0, 2 * KPA))]),
        tg.Stage("down", STATIC, loads=[WEIGHT, AIR, tg.Traction("x1", (0, 0, 0))]),
    )
    errors = [contact_cases.apart(each.states[-1].displacement, together.displacement) for each in (first, last)]
    record_verification(
        claim="weight then pressure, or pressure, a weight that turns and a pressure that falls: as both together",
        source="statics",
        expected=[0.0, 0.0],
        got=errors,
        tolerance="1e-6 of the displacement",
    )
    assert max(errors) < 1e-6
    assert [s.stage for s in first.states if s.load_factor == 1] == ["weight", "pressure"]
    assert first.states[0].load_factor == 0 and sum(s.load_factor == 0 for s in first.states) == 1
    response = tg.measure(first, tg.cavity_volume, mesh_error=False)
    assert response.column("stage")[-1] == 2 and (np.diff(response.column("stage")) > 0).all()
    assert response.column("pressure")[-1] == 20 * KPA
    assert first.message.startswith("weight: Reached load factor 1 in") and "pressure: Reached 20 kPa" in first.message


def test_a_blocked_tip_stays_blocked_from_stage_to_stage():
    held = {"hold": "xz", "direction": "+x", "face": "x1"}
    together = problems.solve(tg.setups.blocked_force(box([WEIGHT, AIR]), **held), STATIC).states[-1]
    stages = tg.Stage("weight", STATIC), tg.Stage("pressure", STATIC, loads=[AIR])
    staged = in_turn(tg.setups.blocked_force(box([WEIGHT]), **held), *stages).states[-1]
    assert contact_cases.apart(staged.displacement, together.displacement) < 1e-6
    expected = tg.measures.blocked_force(together)
    assert expected > 0
    assert tg.measures.blocked_force(staged) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("history", [((0, 0), (0.5, 1), (1, 0.5)), "s**2"])
def test_histories_are_shares_of_the_way(history):
    heavy, turned = tg.Gravity((0, 0, -1), 50.0), tg.Gravity((1, 0, 0), 30.0, history)
    model = continued(box([heavy, AIR]), (1.0, {}), [turned])
    gravity = [load for load in model.loads if isinstance(load, tg.Gravity)]
    assert [load.share(0.7) for load in gravity] == pytest.approx([1 - turned.share(0.7), turned.share(0.7)])
    fall = tg.Pressure("cavity", 10 * KPA, history)
    solution = in_turn(box(), tg.Stage("up", STATIC, loads=[AIR]), tg.Stage("on", STATIC, loads=[fall]))
    for state in named(solution, "on"):
        s = state.load_factor
        assert pressures_of(state)["cavity"] == pytest.approx((20 - 10 * fall.share(s)) * KPA)


def test_sealed_liquid_keeps_its_volume(record_verification):
    solution = in_turn(
        box(friction=0.3),
        tg.Stage("fill", tg.VolumeControl(volume=0.5 * ML, **STEPS)),
        tg.Stage("seal and press", tg.Sealed(**STEPS), moves={"plate": DOWN}),
    )
    filled, pressed = named(solution, "fill")[-1], solution.states[-1]
    rest = solution.states[0]
    grown = [(volume(state) - volume(rest)) / ML for state in named(solution, "seal and press")]
    record_verification(
        claim="volume injected, while a plate presses",
        source="an incompressible liquid",
        expected=[0.5] * len(grown),
        got=grown,
        tolerance="1e-6",
    )
    np.testing.assert_allclose(grown, 0.5, rtol=1e-6)
    assert contact_cases.push(pressed.touches["plate"])[2] < -1.0
    assert pressed.pressures["cavity"] > 1.2 * filled.pressures["cavity"] > 0
    assert tg.measure(solution, tg.cavity_volume, mesh_error=False).column("injected_volume")[-1] == pytest.approx(
        0.5 * ML
    )


def test_sealed_at_rest_while_the_weight_comes_and_goes():
    """The pressure has a maximum, but of the weight and not of the volume: no limit point."""
    solution = problems.solve(box([tg.Gravity((0, 0, -1), 50.0, "sin(pi * s)")]), tg.Sealed(**STEPS))
    pressures = [state.pressures["cavity"] for state in solution.states]
    assert max(map(abs, pressures)) > 100 * abs(pressures[-1])
    assert solution.limit_points == ()
    assert [volume(s) for s in solution.states] == pytest.approx([volume(solution.states[0])] * len(solution.states))


def test_a_pressure_that_was_found_stays_and_is_let_off():
    fill = tg.Stage("fill", tg.VolumeControl(volume=0.5 * ML, **STEPS))
    opened = tg.Stage("open", STATIC, loads=[tg.Pressure("cavity", 0.0)])
    solution = in_turn(box(), fill, tg.Stage("hold", STATIC), opened)
    filled, held = named(solution, "fill")[-1], named(solution, "hold")[-1]
    assert held.pressures["cavity"] == pytest.approx(filled.pressures["cavity"], rel=1e-12)
    assert contact_cases.apart(held.displacement, filled.displacement) < 1e-7
    assert np.abs(solution.states[-1].displacement).max() < 1e-6 * np.abs(filled.displacement).max()
    injected = tg.measure(solution, tg.cavity_volume, mesh_error=False).column("injected_volume")
    grown = [(volume(state) - volume(solution.states[0])) for state in solution.states]
    assert injected == pytest.approx(grown, abs=1e-6 * ML) and max(injected) == pytest.approx(0.5 * ML)


def test_two_injections_are_one(record_verification):
    whole = problems.solve(box(), tg.VolumeControl(volume=0.5 * ML, **STEPS)).states[-1]
    parts = [tg.Stage(f"{v} mL", tg.VolumeControl(volume=v * ML, **STEPS)) for v in (0.8, -0.3)]
    solution = in_turn(box(), *parts)
    last = solution.states[-1]
    assert "-0.3 mL: Reached a volume 0.5 mL larger than at rest at" in solution.message
    apart = contact_cases.apart(last.displacement, whole.displacement)
    record_verification("0.8 mL in, 0.3 mL out against 0.5 mL in: displacement", "statics", 0.0, apart, "1e-6")
    assert apart < 1e-6
    assert last.pressures["cavity"] == pytest.approx(whole.pressures["cavity"], rel=1e-6)


def test_sealed_gas_after_a_static_stage(record_verification):
    thin = tg.GasMass(mass_ratio=1.0, ambient=101_325.0, outside=60e3, **STEPS)
    solution = in_turn(box([AIR]), tg.Stage("inflate", STATIC), tg.Stage("up the mountain", thin))
    start, states = named(solution, "inflate")[-1], named(solution, "up the mountain")
    amount = (20 * KPA + 101_325.0) * volume(start)
    outside = [101_325.0 + s.load_factor * (60e3 - 101_325.0) for s in states]
    results = [(s.pressures["cavity"] + p) * volume(s) / amount for s, p in zip(states, outside, strict=True)]
    record_verification(
        claim="p V of air that was sealed at 20 kPa, while the pressure around falls to 60 kPa",
        source="ideal gas",
        expected=[1.0] * len(results),
        got=results,
        tolerance="1e-6",
    )
    np.testing.assert_allclose(results, 1.0, rtol=1e-6)
    within = tg.GasMass(mass_ratio=1.0, outside=60e3, pressure=20 * KPA, **STEPS)
    alone = problems.solve(box(), within).states[-1]
    assert contact_cases.apart(solution.states[-1].displacement, alone.displacement) < 1e-6


def test_inflate_then_touch(record_verification):
    path = ((0, (0, 0, 0)), (1, DOWN))
    together = problems.solve(box([AIR], 0.0, path), STATIC).states[-1]
    solution = in_turn(
        box(friction=0.0), tg.Stage("inflate", STATIC, loads=[AIR]), tg.Stage("touch", STATIC, moves={"plate": DOWN})
    )
    assert contact_cases.push(named(solution, "inflate")[-1].touches["plate"])[2] == 0
    last = solution.states[-1]
    assert contact_cases.push(last.touches["plate"])[2] < -1.0
    apart = contact_cases.apart(last.displacement, together.displacement)
    claim = "inflated, then met by a plate, against both together: displacement"
    record_verification(claim, "statics", 0.0, apart, "1e-4, the stiffness of contact is raised on the way")
    assert apart < 1e-4


def test_an_obstacle_starts_where_its_path_puts_it():
    away = (5 * MM, 0.0, 20 * MM)
    first = with_loads(box(friction=0.0, path=((0, away), (1, away))), [], moves={"plate": DOWN})
    then = continued(first, (1.0, {}), [])
    paths = [model.contact.obstacles[0].path for model in (first, then)]
    assert paths == [((0.0, away), (1.0, DOWN)), ((0.0, DOWN), (1.0, DOWN))]


def test_friction_is_carried_on(record_verification):
    """A plate that presses and then only waits holds what it held, stuck points included."""
    press = tg.Stage("press", STATIC, moves={"plate": DOWN})
    drag = tg.Stage("drag", STATIC, moves={"plate": (1 * MM, 0, -3 * MM)})
    solution = in_turn(box(friction=0.5), press, drag, tg.Stage("wait", STATIC))
    dragged, waited = named(solution, "drag")[-1], solution.states[-1]
    assert contact_cases.push(dragged.touches["plate"])[0] > 0.5
    apart = contact_cases.apart(waited.displacement, dragged.displacement)
    record_verification("dragged by a plate, then left alone: displacement", "statics", 0.0, apart, "1e-5")
    assert apart < 1e-5


def test_the_rubber_goes_on_remembering(record_verification):
    prony = tg.laws.Prony(g=(0.3, 0.2), tau=(0.5, 5.0), moduli="long_term")
    body = dataclasses.replace(problems.rubber(problems.NEO_HOOKE), viscoelasticity=prony)
    whole = tg.Model(
        box().mesh, {"body": body}, [tg.Fixed("z0")], [tg.Pressure("cavity", 20 * KPA, ((0, 0), (0.5, 1), (1, 1)))]
    )
    asked = {"first_step": 0.1, "max_step": 0.1, "tolerance": 1e-9}
    together = problems.solve(whole, tg.Static(duration=2.0, **asked | {"first_step": 0.05, "max_step": 0.05}))
    second = tg.Static(duration=1.0, **asked)
    still = tg.Model(whole.mesh, whole.materials, whole.supports, [AIR])
    solution = in_turn(still, tg.Stage("inflate", second), tg.Stage("hold", second))
    assert [s.time for s in solution.states] == pytest.approx([s.time for s in together.states])
    inflated, held = named(solution, "inflate")[-1], solution.states[-1]
    assert contact_cases.apart(held.displacement, inflated.displacement) > 0.02  # it creeps
    apart = contact_cases.apart(held.displacement, together.states[-1].displacement)
    claim = "rubber that relaxes, inflated and held in two stages against one: displacement"
    record_verification(claim, "the same equations", 0.0, apart, "1e-6")
    assert apart < 1e-6


def test_the_report_says_what_each_stage_changed():
    fill = tg.Stage("fill", tg.VolumeControl(volume=0.5 * ML))
    on = tg.Stage("on", tg.Sealed(), loads=[WEIGHT], moves={"plate": DOWN})
    assert describe_procedure.procedure(tg.Stages([fill, on])) == [
        ("fill", "VolumeControl (volume 0.5 mL)"),
        ("on", "Sealed; Gravity 50 m/s² along (0, 0, -1); plate moves to (0, 0, -3) mm from where it was at first"),
    ]


def test_a_face_that_is_held_can_be_moved_later():
    """As one that a Displacement holds in its place."""
    up = tg.Displacement("z1", Shift((0.0, 0.0, 1 * MM)), "z")
    stages = [tg.Stage("inflate", STATIC, loads=[AIR]), tg.Stage("pull", STATIC, displacements=[up])]
    held = in_turn(box(supports=[tg.Fixed("z1", "z")]), *stages).states
    still = tg.Displacement("z1", Shift((0.0, 0.0, 0.0)), "z")
    prescribed = in_turn(box(supports=[still]), *stages).states
    top = held[0].model.mesh.face_nodes("z1")
    assert held[-1].displacement[top, 2] == pytest.approx(1 * MM)
    assert contact_cases.apart(held[-1].displacement, prescribed[-1].displacement) < 1e-12
    assert describe_procedure.procedure(tg.Stages(stages))[1][1].endswith(
        "z1 moves to (0, 0, 1) mm from where it was at first"
    )


def test_a_moved_face_stays_and_moves_on():
    def pull(length):
        return tg.Displacement("z1", lambda points, s: np.array([0.0, 0.0, s * length * MM]), "z")

    model = box(supports=[pull(1.0)])
    stages = [tg.Stage("pull", STATIC), tg.Stage("inflate", STATIC, loads=[AIR])]
    solution = in_turn(model, *stages, tg.Stage("back", STATIC, displacements=[pull(-1.0)]))
    top = model.mesh.face_nodes("z1")
    for name, first, last in (("pull", 0, 1), ("inflate", 1, 1), ("back", 1, -1)):
        for state in named(solution, name):
            expected = (first + state.load_factor * (last - first)) * MM
            np.testing.assert_allclose(state.displacement[top, 2], expected, atol=1e-12)


@pytest.mark.parametrize("then", [tg.Stabilized(), tg.Dynamic(duration=0.02, accuracy=1e-2)])
def test_moving_procedures_begin_at_a_state(then, record_verification):
    stages = [tg.Stage("inflate", STATIC, loads=[AIR]), tg.Stage("wait", then)]
    solution = in_turn(box(), *stages)
    inflated = named(solution, "inflate")[-1]
    apart = max(contact_cases.apart(s.displacement, inflated.displacement) for s in named(solution, "wait"))
    claim = f"inflated, then {type(then).__name__} without a change: displacement"
    record_verification(claim, "a body in equilibrium stays at rest", 0.0, apart, "1e-5")
    assert apart < 1e-5
    for state in named(solution, "wait"):
        assert state.pressures["cavity"] == pytest.approx(20 * KPA)


def test_auto_may_come_first_and_a_stage_that_stops_ends_it():
    stages = [tg.Stage("inflate", tg.Auto(), loads=[AIR]), tg.Stage("on", STATIC), tg.Stage("more", STATIC)]
    seen = []

    def stop(state):
        seen.append(state.stage)
        return "enough" if state.stage == "on" else None

    solution = in_turn(box(), *stages, stop=stop, throw=False)
    assert solution.status == "stopped" and solution.states[-1].stage == "on"
    assert "inflate: Reached 20 kPa" in solution.message and "enough" in solution.message
    assert set(seen) == {"inflate", "on"}


def ball(*loads):
    """A thick sphere with a pressure, which cannot bear 118.6 kPa."""
    return problems.one_material(meshes.sphere_octant(10 * MM, 15 * MM, 1, 2), problems.NEO_HOOKE, loads=loads)


@pytest.mark.parametrize(
    "then", [tg.ArcLength(max_stretch=1.8), tg.Auto(max_stretch=1.8, past=1.05)], ids=["arc", "auto"]
)
def test_a_limit_point_is_met_from_a_stage_as_from_rest(then, record_verification):
    full = tg.Pressure("cavity", 125 * KPA)
    (alone,) = problems.solve(ball(full), tg.ArcLength(max_stretch=1.8)).limit_points
    first = tg.Stage("up", STATIC, loads=[tg.Pressure("cavity", 60 * KPA)])
    solution = in_turn(ball(), first, tg.Stage("on", then, loads=[full]), tg.Stage("hold", tg.Sealed(**STEPS)))
    (limit,) = solution.limit_points
    record_verification(
        claim=f"maximum of the pressure that {type(then).__name__} finds as a second stage, over that from rest",
        source="the same problem",
        expected=[1.0],
        got=[limit.pressure / alone.pressure],
        tolerance="1e-6",
    )
    assert limit.pressure == pytest.approx(alone.pressure, rel=1e-6)
    assert limit.load_factor == pytest.approx((limit.pressure / KPA - 60) / 65)
    assert solution.states[limit.state].pressures["cavity"] == pytest.approx(limit.pressure)
    assert "on: Followed the path" in solution.message
    assert "the largest stretch has reached" in solution.message  # the arc leads in a later stage, whatever the volume
    # what comes next begins on the falling branch
    last, held = named(solution, "on")[-1], solution.states[-1]
    assert 60 * KPA < held.pressures["cavity"] < 0.999 * limit.pressure
    assert contact_cases.apart(held.displacement, last.displacement) < 1e-6


def test_an_arc_goes_on_under_what_acts():
    """The weight stays while the pressure grows along the arc, and back to nothing."""
    arc = tg.ArcLength(first_step=0.25, max_step=0.5, tolerance=1e-9)
    off = [tg.Pressure("cavity", 0.0), tg.Gravity((0, 0, -1), 0.0)]
    stages = [tg.Stage("weight", STATIC), tg.Stage("air", arc, loads=[AIR]), tg.Stage("off", arc, loads=off)]
    solution = in_turn(box([WEIGHT]), *stages)
    both = problems.solve(box([WEIGHT, AIR]), STATIC).states[-1]
    assert contact_cases.apart(named(solution, "air")[-1].displacement, both.displacement) < 1e-6
    assert np.abs(solution.states[-1].displacement).max() < 1e-6 * np.abs(both.displacement).max()


def test_an_arc_begins_where_the_last_stage_ended():
    """On the falling branch, where it grows on as the pressure falls; the loads alone do not tell."""
    fill = tg.Stage("fill", tg.VolumeControl(volume=20 * ML, max_step=0.2))
    arc = tg.ArcLength(first_step=0.01, max_step=0.2, max_stretch=2.0)
    solution = in_turn(ball(), fill, tg.Stage("on", arc, loads=[tg.Pressure("cavity", 0.0)]))
    states = [named(solution, "fill")[-1], *named(solution, "on")]
    assert len(states) > 3
    assert (np.diff([volume(state) for state in states]) > 0).all()
    assert (np.diff([state.pressures["cavity"] for state in states]) < 0).all()


MOVE = tg.Displacement("x1", lambda points, s: np.zeros(3))


@pytest.mark.parametrize(
    ("make", "facts"),
    [
        (lambda: tg.Stages([]), ["no stages"]),
        (lambda: tg.Stages([tg.Stage("a"), tg.Stage("a")]), ["2 stages", "'a'"]),
        (lambda: tg.Stage(" "), ["stage", "name", "'fill'"]),
        (lambda: in_turn(box([AIR]), tg.Stage("a"), tg.Stage("b", tg.ArcLength())), ["'b'", "ArcLength", "none"]),
        (
            lambda: in_turn(box(), tg.Stage("a", tg.ArcLength(), loads=[tg.Pressure("cavity", 1e3, "s**2")])),
            ["'a'", "ArcLength", "proportion", "histories"],
        ),
        (
            lambda: in_turn(box([AIR], 0.0), tg.Stage("a", tg.ArcLength(), moves={"plate": DOWN})),
            ["'a'", "ArcLength", "'plate'"],
        ),
        (
            lambda: tg.Stages([tg.Stage("a"), tg.Stage("b", tg.GasMass(mass_ratio=1.0, pressure=1e3))]),
            ["'b'", "procedure.pressure", "1000 Pa"],
        ),
        (lambda: in_turn(box(), tg.Stage("a", loads=[AIR, AIR])), ["'a'", "cavity", "twice"]),
        (lambda: in_turn(box(), tg.Stage("a", moves={"plte": DOWN})), ["'a'", "'plte'"]),
        (lambda: in_turn(box(), tg.Stage("a", displacements=[MOVE])), ["'a'", "'x1' in xyz", "Fixed"]),
        (
            lambda: in_turn(box(), tg.Stage("a", loads=[AIR]), tg.Stage("b", tg.Sealed(), loads=[AIR])),
            ["'b'", "cavity", "pressure load", "procedure.cavities"],
        ),
        (
            lambda: in_turn(box(), tg.Stage("a", tg.Sealed(cavities="cavety"))),
            ["'a'", "procedure.cavities", "'cavety'", "'cavity'"],
        ),
    ],
)
def test_what_does_not_fit_is_said(make, facts):
    with refused(*facts):
        make()
