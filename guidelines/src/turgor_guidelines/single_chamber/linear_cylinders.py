"""Guideline 7.1-8: cylinders respond in a more linear way, and wear less."""

import numpy as np

import turgor as tg
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Verdict
from turgor_guidelines.single_chamber.best_shape import extension_runs
from turgor_guidelines.single_chamber.shapes import PRESSURE, ROUND, SETUP, bars
from turgor_guidelines.values import linearity
from turgor_guidelines.wear import lives, tearing

#: Stretch of the actuator at which the rubber is compared; all shapes reach it, bare ones too.
STRETCH = 1.01


def worn(runs: Runs) -> dict[str, float]:
    """Stretch that 99 % of the rubber stay below where the actuator has the same stretch."""
    return {
        name: float(np.interp(STRETCH, each.response["stretch"], each.response["principal_stretch_p99"], right=np.nan))
        for name, each in runs.items()
    }


def straight(runs: Runs) -> dict[str, float]:
    """R² of the stretch against the pressure."""
    return {name: linearity(each.response, "stretch", "pressure", PRESSURE * kPa) for name, each in runs.items()}


def judge(runs: Runs) -> Judgement:
    """Whether the round section has the largest R² and the smallest stretch of the rubber."""
    wear, lines, parts, good, longer = worn(runs), straight(runs), [], [], []
    torn = {name: tearing(stretch) for name, stretch in wear.items()}
    for way in dict.fromkeys(name.split(", ")[0] for name in runs):
        names = [name for name in runs if name.split(", ")[0] == way]
        of_round = f"{way}, {ROUND}"
        line, spared = max(names, key=lambda each: lines[each]), min(names, key=lambda each: wear[each])
        good += [line == of_round, spared == of_round]
        second = min((name for name in names if name != of_round), key=lambda each: wear[each])
        longer.append(f"{of_round} lasts {lives(torn[of_round], torn[second])} as long as {second.split(', ')[1]}")
        parts.append(f"{way}: straightest {line.split(', ')[1]}, rubber stretched least in {spared.split(', ')[1]}")
    verdict = Verdict.CONFIRMED if all(good) else Verdict.CONDITIONAL
    return Judgement(
        verdict=verdict if any(good) else Verdict.NOT_REPRODUCED,
        finding=f"R² up to {PRESSURE:g} kPa, and at a stretch of {STRETCH:g} the stretch that 99 % of the rubber stay "
        "below and the tearing energy of a flaw of 0.1 mm there [J/m²]: "
        + "; ".join(f"{name} {lines[name]:.5f}, {wear[name]:.3f}, {torn[name]:.3g}" for name in runs)
        + ".",
        conditions="; ".join(parts)
        + ". Wear is judged by the energy that opens flaws, from which cracks grow with its 2nd to 4th power, where "
        "it suffices for growth at all: "
        + "; ".join(longer)
        + ". The inner corners of the other shapes are stretched more than 99 % of the rubber.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Stretch of the rubber against that of the actuator, and R² by shape."""
    lines = [
        tg.pictures.Line(x=each.response["stretch"], y=each.response["principal_stretch_p99"], label=name)
        for name, each in runs.items()
        if name.startswith("hoops")
    ]
    ways: dict[str, tuple[list[str], list[float]]] = {}
    for name, value in straight(runs).items():
        way, shape = name.split(", ")
        ways.setdefault(way, ([], []))[0].append(shape)
        ways[way][1].append(value)
    return (
        tg.pictures.Panel(x="stretch of the actuator [-]", y="stretch of the rubber (99 %) [-]", lines=lines),
        tg.pictures.Panel(
            x="",
            y="R² of a straight line [-]",
            lines=[tg.pictures.Line(x=x, y=y, label=way) for way, (x, y) in ways.items()],
        ),
        bars(runs, "principal_stretch_p99", f"stretch of the rubber (99 %) at {PRESSURE:g} kPa [-]"),
    )


GUIDELINE = Guideline(
    key="7.1-8",
    rule="Cylindrical actuators have a more linear response, and show less wear and tear.",
    sources=("Fras and Althoefer 2019",),
    families=("extending_cylinder", "fiber_reinforced_cylinder"),
    studies=(
        GuidelineTest(
            title="Straightness and stretch of the rubber for five shapes",
            setup=f"{SETUP}; in hoops of Kevlar thread every 2 mm or bare; R² of the stretch up to 30 kPa, and the "
            "stretch that 99 % of the rubber stay below, and the tearing energy of a flaw there, where the actuator "
            "has a stretch of 1.01.",
            expected="The round one has the largest R² and the smallest tearing energy.",
            runs=extension_runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
