"""Guideline 7.3-3: half-round chambers balloon least, ring sectors bend most."""

import turgor as tg
from turgor.studies import Run
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import verdict_of
from turgor_guidelines.omnidirectional.chambers import SETUP
from turgor_guidelines.omnidirectional.shapes import AREA, SHAPES, read, runs_of
from turgor_guidelines.values import Value

#: Pressures of the comparison [kPa].
PRESSURES = (10, 60)


def runs(setting: Setting) -> tuple[Run, ...]:
    """All shapes."""
    return runs_of(tuple(SHAPES), setting)


def _ballooning(runs: Runs, pressure: float) -> dict[str, Value]:
    """Widening of the outside in percent."""
    values = read(runs, "outside_ballooning", pressure)
    return {name: Value(100 * (each.number - 1), 100 * each.error, "%") for name, each in values.items()}


def judge(runs: Runs) -> Judgement:
    """Which shape bends most and which balloons least, at equal pressure and at equal angle."""
    holds, parts, notes = [], [], []
    for pressure in PRESSURES:
        angles, wide = read(runs, "bending_angle", pressure), _ballooning(runs, pressure)
        most = max(angles, key=lambda name: angles[name].number)
        least = min(wide, key=lambda name: wide[name].number)
        least_each = min(wide, key=lambda name: wide[name].number / angles[name].number)
        holds += [most == "ring sector", least.startswith("half"), least_each.startswith("half")]
        parts += [f"at {pressure} kPa " + "; ".join(f"{n} {angles[n]}, {wide[n]} wider" for n in angles)]
        notes += [
            f"At {pressure} kPa {most} bends most, {least} balloons least, and least for the same angle: {least_each}."
        ]
    return Judgement(verdict=verdict_of(holds), finding=", ".join(parts), conditions=" ".join(notes))


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Angle against pressure, ballooning against angle."""
    curves = tuple((name, each.response) for name, each in runs.items())
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=curves),
        tg.pictures.Panel(x="bending_angle", y="outside_ballooning", responses=curves),
    )


GUIDELINE = Guideline(
    key="7.3-3",
    rule="Of the chambers of omnidirectional actuators, semi-circular ones balloon least and ring sectors bend most.",
    sources=("Elsayed et al. 2014",),
    families=("omnidirectional_actuator", "three_extenders"),
    studies=(
        GuidelineTest(
            title="Six shapes of equal area",
            setup=SETUP
            + f"; all chambers have {AREA:g} mm² and end 2 mm below the surface. Ballooning is the widening of "
            "the outside, the square root of the ratio of areas.",
            expected="Ring sectors have the largest angle, half circles the least ballooning.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
