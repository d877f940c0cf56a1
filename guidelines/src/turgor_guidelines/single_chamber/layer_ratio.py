"""Guideline 7.1-2: bending is largest when one layer is two to three times as stiff or as thick as the other."""

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import MPa, kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.parts import elastosil, threads
from turgor_guidelines.sections import solved_twice
from turgor_guidelines.single_chamber.half_round import BARE, HOOPED, cells
from turgor_guidelines.values import Value, largest, last, listed, rises

#: Inner and outer radius [mm], modulus C10 of the softer layer [MPa], last pressure [kPa].
INNER, OUTER, C10, PRESSURE = 6.35, 8.35, 0.12, 20.0

#: Ratios of stiffness and of thickness, and those that the rule names.
STIFFNESS, THICKNESS, NAMED = (
    (1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0, 20.0),
    (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0),
    (2.0, 3.0),
)


def bend_stiff(ratio: float, hooped: bool, size: float) -> Computed:
    """Bend a round tube whose lower half is so many times as stiff as the upper one."""
    soft, stiff = (
        tg.Material(name=name, law=tg.laws.NeoHooke(C10=C10 * factor * MPa))
        for name, factor in (("soft", 1.0), ("stiff", ratio))
    )
    shape = tg.actuators.TwoMaterialBender(inner_radius=INNER * mm, wall=(OUTER - INNER) * mm, base_height=OUTER * mm)
    return _bend(shape, {"body": soft, "base": stiff}, hooped, size)


def bend_thick(ratio: float, hooped: bool, size: float) -> Computed:
    """Bend a round tube whose wall below is so many times as thick as the wall above, with the same sum."""
    offset = max((OUTER - INNER) * (ratio - 1) / (ratio + 1), 0.01)  # a chamber in the middle is refused
    shape = tg.actuators.EccentricBender(outer_radius=OUTER * mm, inner_radius=INNER * mm, offset=offset * mm)
    return _bend(shape, {"body": elastosil()}, hooped, size)


def _bend(
    shape: tg.actuators.TwoMaterialBender | tg.actuators.EccentricBender,
    materials: dict[str, tg.Material],
    hooped: bool,
    size: float,
) -> Computed:
    def solve(cell: float) -> tg.sections.SectionSolution:
        section = tg.Section(shape, materials, reinforcements=[threads()] if hooped else [], size=cell)
        return section.solve(np.linspace(0, PRESSURE * kPa, 11), throw=False, mesh_error=False)

    return solved_twice(solve, size * mm)


def _runs(setting: Setting, stiffness: bool) -> tuple[Run, ...]:
    return tuple(
        Run(
            name=f"{around}, ratio {ratio:g}",
            function=bend_stiff if stiffness else bend_thick,
            values={"ratio": ratio, "hooped": around == HOOPED, "size": cells(setting)},
        )
        for around in (BARE, HOOPED)
        for ratio in (STIFFNESS if stiffness else THICKNESS)
    )


def stiffness_runs(setting: Setting) -> tuple[Run, ...]:
    """Ratios of stiffness, bare and in hoops."""
    return _runs(setting, stiffness=True)


def thickness_runs(setting: Setting) -> tuple[Run, ...]:
    """Ratios of thickness, bare and in hoops."""
    return _runs(setting, stiffness=False)


def bends(runs: Runs, around: str, mean: bool = False) -> tuple[list[float], list[Value]]:
    """Ratios and curvatures at the last pressure.

    With ``mean``, at the mean stiffness of ratio 1 instead of the softer part: neo-Hookean rubber knows the pressure
    over its modulus only, so that it is the curvature at a pressure 2 / (1 + ratio) times as large.
    """
    chosen = {float(name.split()[-1]): each.response for name, each in runs.items() if name.startswith(around)}
    if not mean:
        return list(chosen), [last(each, "curvature_y") for each in chosen.values()]
    from scipy.interpolate import CubicSpline  # slow to load, and guidelines are listed without it

    scaled = {n: PRESSURE * kPa * 2 / (1 + n) for n in chosen}
    numbers = [float(CubicSpline(each["pressure"], each["curvature_y"])(scaled[n])) for n, each in chosen.items()]
    return list(chosen), [Value(number, 0.0, "1/m") for number in numbers]


def _summary(ratios: list[float], values: list[Value]) -> str:
    top = largest(values)
    if top == len(values) - 1 and rises(values):
        return f"rises up to {ratios[top]:g}, and by {values[-1].number / values[-2].number - 1:.1%} in the last step"
    return f"largest at {ratios[top]:g}"


def _judge(runs: Runs, ways: dict[str, tuple[list[float], list[Value]]]) -> Judgement:
    """Whether the largest curvature lies at the ratios that the rule names."""
    inside = {way: NAMED[0] <= ratios[largest(values)] <= NAMED[1] for way, (ratios, values) in ways.items()}
    verdict = Verdict.CONFIRMED if all(inside.values()) else Verdict.CONDITIONAL
    ratios, values = ways[HOOPED]
    share = [values[ratios.index(each)].number / max(value.number for value in values) for each in NAMED]
    summary = "; ".join(f"{way}: {listed(values)}" for way, (_, values) in ways.items())
    return Judgement(
        verdict=verdict if any(inside.values()) else Verdict.NOT_REPRODUCED,
        finding=f"Curvature at {PRESSURE:g} kPa for ratios {', '.join(f'{each:g}' for each in ratios)}: {summary}.",
        conditions="; ".join(f"{way}: {_summary(*each)}" for way, each in ways.items())
        + f". In hoops, ratios of {NAMED[0]:g} and {NAMED[1]:g} give {share[0]:.0%} and {share[1]:.0%} of the largest "
        "curvature seen.",
    )


def judge_stiffness(runs: Runs) -> Judgement:
    """Judge curvatures at a fixed softer part, and at a fixed mean stiffness."""
    softest = {around: bends(runs, around) for around in (BARE, HOOPED)}
    means = {f"{around}, mean stiffness kept": bends(runs, around, mean=True) for around in (BARE, HOOPED)}
    return _judge(runs, softest | means)


def judge_thickness(runs: Runs) -> Judgement:
    """Judge curvatures at a fixed sum of both walls."""
    return _judge(runs, {around: bends(runs, around) for around in (BARE, HOOPED)})


def stiffness_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature against the ratio, each over its largest value."""
    return _panels(runs, "stiffness of the lower over the upper half", (False, True))


def thickness_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature against the ratio."""
    return _panels(runs, "wall below over wall above", (False,))


def _panels(runs: Runs, label: str, means: tuple[bool, ...]) -> tuple[tg.pictures.Panel, ...]:
    drawn = []
    for around in (BARE, HOOPED):
        lines = []
        for mean in means:
            ratios, values = bends(runs, around, mean)
            name = "mean kept" if mean else "softer half kept" if len(means) > 1 else ""
            error = [each.error for each in values]
            lines.append(tg.pictures.Line(x=ratios, y=[each.number for each in values], error=error, label=name))
        drawn.append(tg.pictures.Panel(x=label, y=f"{around}: curvature at {PRESSURE:g} kPa [1/m]", lines=lines))
    return tuple(drawn)


TUBE = (
    "Section of a long round tube (inner radius 6.35 mm, outer 8.35 mm, closed ends), bare or in hoops of Kevlar "
    "thread every 2 mm"
)

GUIDELINE = Guideline(
    key="7.1-2",
    rule="Bending is largest when one of the layers is two to three times as rigid or as thick as the other.",
    sources=("Gorissen et al. 2017", "Marchese et al. 2015", "Gorissen et al. 2011"),
    families=("two_material_bender", "eccentric_bender"),
    studies=(
        GuidelineTest(
            title="Ratio of stiffness of two halves",
            setup=f"{TUBE}; neo-Hookean halves, C10 = 0.12 MPa above and 1 to 20 times as much below; or with the "
            "mean of both fixed at 0.12 MPa; curvature at 20 kPa.",
            expected="The curvature is largest at a ratio between 2 and 3.",
            runs=stiffness_runs,
            judge=judge_stiffness,
            panels=stiffness_panels,
        ),
        GuidelineTest(
            title="Ratio of thickness of two walls",
            setup=f"{TUBE}, the chamber off the axis so that the wall below is 1 to 6 times as thick as the wall "
            "above, both together 4 mm; Elastosil M4601 (neo-Hookean, C10 = 0.12 MPa); curvature at 20 kPa.",
            expected="The curvature is largest at a ratio between 2 and 3.",
            runs=thickness_runs,
            judge=judge_thickness,
            panels=thickness_panels,
        ),
    ),
)
