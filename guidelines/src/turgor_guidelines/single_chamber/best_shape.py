"""Guideline 7.1-6: half-round actuators are best for bending, cylinders for extension."""

import turgor as tg
from turgor.studies import Run
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.single_chamber.shapes import (
    FABRIC,
    HALF,
    NONE,
    PLATE,
    PRESSURE,
    ROUND,
    SETUP,
    bars,
    by_way,
    runs,
)
from turgor_guidelines.values import Value

#: A half round that turns more than this share of its length [1/m] extends and bends at once.
STRAIGHT = 0.01


def bending_runs(setting: Setting) -> tuple[Run, ...]:
    """In hoops on a base that may bulge, in hoops on one that stays flat, and bare on that one."""
    return runs(setting, ((True, FABRIC), (True, PLATE), (False, PLATE)))


def extension_runs(setting: Setting) -> tuple[Run, ...]:
    """In hoops and bare."""
    return runs(setting, ((True, NONE), (False, NONE)))


def best(values: dict[str, Value]) -> str:
    """Shape of the largest value."""
    return max(values, key=lambda shape: values[shape].number)


def _summary(values: dict[str, Value]) -> str:
    return ", ".join(f"{shape} {each}" for shape, each in values.items())


def judge_bending(runs: Runs) -> Judgement:
    """Which shape bends most, in each way."""
    ways = by_way(runs, "curvature_y")
    first = {way: best(values) for way, values in ways.items()}
    share = {way: values[HALF].number / values[first[way]].number for way, values in ways.items()}
    against = {way: values[HALF].number / values[ROUND].number for way, values in ways.items()}
    right = [way for way, shape in first.items() if shape == HALF]
    verdict = Verdict.CONFIRMED if len(right) == len(ways) else Verdict.CONDITIONAL
    return Judgement(
        verdict=verdict if right else Verdict.NOT_REPRODUCED,
        finding=f"Curvature at {PRESSURE:g} kPa: "
        + "; ".join(f"{way}: {_summary(values)}" for way, values in ways.items())
        + ".",
        conditions="; ".join(
            f"{way}: most with {first[way]}, half round has {share[way]:.0%} of it and {against[way]:.2f} times the "
            "curvature of round"
            for way in ways
        )
        + ". Chamber area and wall are the same; the base decides, since one that bulges lets the half round become "
        "round.",
    )


def judge_extension(runs: Runs) -> Judgement:
    """Which shape extends most, and which of them stays straight."""
    ways, turns = by_way(runs, "stretch"), by_way(runs, "curvature")
    first = {way: best(values) for way, values in ways.items()}
    straight = {
        way: best({shape: each for shape, each in values.items() if turns[way][shape].number < STRAIGHT})
        for way, values in ways.items()
    }
    right = [way for way, shape in first.items() if shape == ROUND]
    among = [way for way, shape in straight.items() if shape == ROUND]
    wide = by_way(runs, "outside_ballooning")
    verdict = Verdict.CONFIRMED if len(right) == len(ways) else Verdict.CONDITIONAL
    return Judgement(
        verdict=verdict if right or among else Verdict.NOT_REPRODUCED,
        finding=f"Stretch at {PRESSURE:g} kPa: "
        + "; ".join(f"{way}: {_summary(values)}" for way, values in ways.items())
        + ".",
        conditions="; ".join(
            f"{way}: longest with {first[way]}, of those that stay straight with {straight[way]}; sections grow by "
            + ", ".join(f"{shape} {each.number - 1:.1%}" for shape, each in wide[way].items())
            for way in ways
        )
        + ". Chamber area and wall are the same.",
    )


def bending_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature against the shape, and against pressure in hoops on a plate."""
    return (bars(runs, "curvature_y", f"curvature at {PRESSURE:g} kPa [1/m]"), _curves(runs, "curvature_y", "plate"))


def extension_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Stretch against the shape, and against pressure in hoops."""
    return (bars(runs, "stretch", f"stretch at {PRESSURE:g} kPa [-]"), _curves(runs, "stretch", "hoops"))


def _curves(runs: Runs, name: str, kind: str) -> tg.pictures.Panel:
    chosen = tuple((key, each.response) for key, each in runs.items() if key.startswith("hoops") and kind in key)
    return tg.pictures.Panel(x="pressure", y=name, responses=chosen)


GUIDELINE = Guideline(
    key="7.1-6",
    rule="Semicircular actuators are optimal for bending, cylindrical actuators for extension.",
    sources=("Polygerinos et al. 2015", "Xavier, Fleming and Yong 2019", "Fras and Althoefer 2019"),
    families=("semicircular_bender", "rectangular_bender", "extending_cylinder"),
    studies=(
        GuidelineTest(
            title="Bending of five shapes on two bases",
            setup=f"{SETUP}; in hoops of Kevlar thread every 2 mm or bare; on a fabric of 650 N/mm along the lowest "
            "1 mm, which may bulge, or with the lowest 1 mm as a plate (C10 = 50 MPa), which stays flat; curvature "
            "at 30 kPa.",
            expected="The half round bends most.",
            runs=bending_runs,
            judge=judge_bending,
            panels=bending_panels,
        ),
        GuidelineTest(
            title="Extension of five shapes",
            setup=f"{SETUP}; in hoops of Kevlar thread every 2 mm or bare; stretch at 30 kPa.",
            expected="The round one extends most.",
            runs=extension_runs,
            judge=judge_extension,
            panels=extension_panels,
        ),
    ),
)
