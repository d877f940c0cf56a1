"""Guideline 7.3-4: parallel bellows bend further where they are constrained, with thin walls and wide chambers."""

from typing import Any

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import change, differs, line_of, verdict_of
from turgor_guidelines.parts import elastosil
from turgor_guidelines.pictures import picture_of
from turgor_guidelines.values import Value, at, falls, last, listed, rises

#: Pressures in one of three bellows at which they are compared [kPa].
PRESSURES = (0.5, 1.5)

#: Walls and inner radii [mm] of single bellows, and their pressure [kPa].
WALLS, RADII, SINGLE = (1.0, 1.25, 1.5), (6.0, 8.0, 10.0), 0.5

#: Height of a fold [mm], fixed where the inner radius changes.
FOLD = 6.0


def bend(constrained: bool, size: float) -> Computed:
    """Bend three parallel bellows by pressure in one of them, with ribs that hold them together or without."""
    actuator = tg.actuators.ParallelBellows(constrained=constrained, symmetric=True)
    part = actuator.build()
    model = tg.Model(
        tg.mesh(part, size=size * mm),
        materials=dict.fromkeys(part.regions, elastosil()),
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity_1", PRESSURES[-1] * kPa)],
    )
    solution = tg.solve(model, tg.Static(at=(PRESSURES[0] / PRESSURES[1], 1.0)), throw=False)
    return Computed(response=tg.measure(solution, tg.bending_angle), picture=picture_of(solution))


def extend(wall: float, inner_radius: float, blocked: bool) -> Computed:
    """Extend one bellows, which is what bends three of them; or hold it at its length."""
    actuator = tg.actuators.BellowsOfRevolution(
        folds=2, wall=wall * mm, inner_radius=inner_radius * mm, outer_radius=(inner_radius + FOLD + wall) * mm
    )
    part = actuator.build()
    supports: list[Any] = [tg.Fixed("fixed")]
    model = tg.Model(
        tg.mesh(part, cells="axisymmetric"),
        materials=dict.fromkeys(part.regions, elastosil()),
        supports=supports,
        loads=[tg.Pressure("cavity", SINGLE * kPa)],
    )
    if blocked:
        solution = tg.solve(tg.setups.blocked_force(model, direction="+x"), throw=False)
        return Computed(response=tg.measure(solution, tg.measures.blocked_force))
    solution = tg.solve(model, throw=False)
    return Computed(response=tg.measure(solution, tg.measures.tip_displacement_x))


def kinds(setting: Setting) -> tuple[Run, ...]:
    """With ribs and without."""
    size = 5.0 if setting == "quick" else 2.5
    return tuple(
        Run(name=name, function=bend, values={"constrained": ribbed, "size": size})
        for name, ribbed in (("unconstrained", False), ("constrained", True))
    )


def dimensions(setting: Setting) -> tuple[Run, ...]:
    """Walls and radii, free and blocked; axisymmetric cells are cheap, so both settings have all."""
    del setting
    return tuple(
        Run(
            name=f"{name}{', blocked' if blocked else ''}",
            function=extend,
            values={"wall": wall, "inner_radius": radius, "blocked": blocked},
        )
        for name, wall, radius in _shapes()
        for blocked in (False, True)
    )


def _shapes() -> tuple[tuple[str, float, float], ...]:
    walls = tuple((f"wall {wall:g} mm", wall, RADII[1]) for wall in WALLS)
    return walls + tuple((f"inner radius {radius:g} mm", WALLS[1], radius) for radius in RADII)


def judge_kinds(runs: Runs) -> Judgement:
    """The constrained ones bend further at both pressures."""
    holds, parts, apart = [], [], False
    for pressure in PRESSURES:
        free, ribbed = (at(each.response, "bending_angle", "pressure", pressure * kPa) for each in runs.values())
        holds.append(rises([free, ribbed]))
        apart = apart or differs(free, ribbed)
        parts.append(f"{listed([free, ribbed])} at {pressure:g} kPa ({change(ribbed, free):+.1%})")
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"Without and with ribs: {'; '.join(parts)}",
        conditions="The rule does not say what constrains them. Here it is a rib that ties the three together in the "
        "middle." + ("" if apart else " Both differ by less than their mesh errors."),
    )


def judge_dimensions(runs: Runs) -> Judgement:
    """Thinner walls and wider bellows extend further and push harder."""
    ways, forces = (
        {name: last(runs[name + end].response, column) for name, _, _ in _shapes()}
        for end, column in (("", "tip_displacement_x"), (", blocked", "blocked_force"))
    )
    holds, parts = [], []
    for values, what in ((ways, "extension"), (forces, "blocked force")):
        thin, wide = ([values[name] for name, _, _ in part] for part in (_shapes()[:3], _shapes()[3:]))
        holds += [falls(thin), rises(wide)]
        parts.append(f"{what}, walls {listed(thin)}, inner radii {listed(wide)}")
    return Judgement(verdict=verdict_of(holds), finding=f"At {SINGLE:g} kPa: {'; '.join(parts)}")


def panels_kinds(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Angle against pressure."""
    return (
        tg.pictures.Panel(
            x="pressure", y="bending_angle", responses=[(name, each.response) for name, each in runs.items()]
        ),
    )


def panels_dimensions(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Extension and force against wall and radius."""
    out = []
    for end, column, label in (
        ("", "tip_displacement_x", "extension [mm]"),
        (", blocked", "blocked_force", "blocked force [N]"),
    ):
        for part, x in ((_shapes()[:3], "wall [mm]"), (_shapes()[3:], "inner radius [mm]")):
            numbers: list[float] = [wall if x.startswith("wall") else radius for _, wall, radius in part]
            values: list[Value] = [last(runs[name + end].response, column) for name, _, _ in part]
            out.append(tg.pictures.Panel(x=x, y=label, lines=[line_of(numbers, values)]))
    return tuple(out)


GUIDELINE = Guideline(
    key="7.3-4",
    rule="Constrained parallel bellows bend further than unconstrained ones; thinner bellows and a larger inner "
    "diameter give more bending and blocked force.",
    sources=("Drotman et al. 2019",),
    families=("parallel_bellows", "bellows_of_revolution"),
    studies=(
        GuidelineTest(
            title="With a rib and without",
            setup="Three parallel bellows of four folds of 7 mm, radii of 5 and 10 mm, wall 1.2 mm, Elastosil M4601 "
            f"(neo-Hooke, 0.12 MPa), {PRESSURES[-1]} kPa in one; half the actuator.",
            expected="A larger angle with the rib.",
            runs=kinds,
            judge=judge_kinds,
            panels=panels_kinds,
        ),
        GuidelineTest(
            title="Wall and inner radius of one bellows",
            setup=f"Bellows of two folds of 10 mm, {FOLD:g} mm high between inner radius and wall, Elastosil M4601 "
            f"(neo-Hooke, 0.12 MPa), {SINGLE:g} kPa; free, or with a fixed length. Three in parallel bend by the "
            "difference of their lengths over their distance.",
            expected="Extension and force fall with the wall and rise with the inner radius.",
            runs=dimensions,
            judge=judge_dimensions,
            panels=panels_dimensions,
        ),
    ),
)
