"""Guideline 7.3-1: what bends an omnidirectional actuator most: wall, length, chamber diameter, central diameter."""

from collections.abc import Mapping
from math import log

import turgor as tg
from turgor.studies import Run
from turgor_guidelines.factorials import analyses, corner_name, corners, share_lines, shares_text
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.omnidirectional.chambers import REFERENCE, SETUP, angle_at, omni
from turgor_guidelines.values import Value, listed

#: Pressures of the comparison, low and high [kPa].
PRESSURES = (20, 100)

#: Expected order and signs.
SIGNS = {"wall": -1, "length": 1, "chamber diameter": 1, "central diameter": -1}


def _changed(scales: Mapping[str, float]) -> dict[str, float]:
    """Dimensions [mm] with some multiplied; the outer radius follows, so that one changes at a time.

    The chambers lie on a circle of radius outer radius - wall - chamber size / 2; the central diameter is what they
    leave free in the middle.
    """
    wall, chamber = REFERENCE["wall"], REFERENCE["chamber_size"]
    free = REFERENCE["outer_radius"] - wall - chamber
    wall *= scales.get("wall", 1)
    chamber *= scales.get("chamber diameter", 1)
    free *= scales.get("central diameter", 1)
    length = REFERENCE["length"] * scales.get("length", 1)
    return dict(REFERENCE) | {
        "wall": wall,
        "chamber_size": chamber,
        "outer_radius": free + chamber + wall,
        "length": length,
    }


def runs(setting: Setting) -> tuple[Run, ...]:
    """Each parameter a tenth less and more."""
    size = 2.0 if setting == "quick" else 1.0
    out = [Run(name="reference", function=omni, values=_values(dict(REFERENCE), size))]
    for what in SIGNS:
        for factor in (0.9, 1.1):
            values = _values(_changed({what: factor}), size)
            out.append(Run(name=f"{what} x {factor:g}", function=omni, values=values))
    return tuple(out)


def _values(given: dict[str, float], size: float) -> dict[str, object]:
    return {"given": given, "size": size, "pressure": PRESSURES[-1]}


def corner_runs(setting: Setting) -> tuple[Run, ...]:
    """All combinations of parameters a tenth less and more."""
    size = 2.0 if setting == "quick" else 1.0
    return tuple(
        Run(name=corner_name(scales), function=omni, values=_values(_changed(scales), size))
        for scales in corners(list(SIGNS))
    )


def judge_corners(runs: Runs) -> Judgement:
    """Signs of the effects, and the order of their shares of the variance."""
    tables = analyses(runs, list(SIGNS), PRESSURES)
    holds = [each.effect(name) * sign > 0 for each in tables.values() for name, sign in SIGNS.items()]
    holds += [each.ranking == tuple(SIGNS) for each in tables.values()]
    notes = [f"At {pressure} kPa the order is {', '.join(each.ranking)}." for pressure, each in tables.items()]
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"shares of the sum of squares; {shares_text(tables)}",
        conditions=" ".join(notes),
    )


def corner_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Shares of the variance."""
    lines = share_lines(analyses(runs, list(SIGNS), PRESSURES))
    return (tg.pictures.Panel(x="parameter", y="share of the sum of squares [%]", lines=lines),)


def _sensitivities(runs: Runs, pressure: float) -> dict[str, Value]:
    """Change of log angle for a change of the log of each parameter."""
    out = {}
    for what in SIGNS:
        low, high = (angle_at(runs[f"{what} x {factor:g}"].response, pressure) for factor in (0.9, 1.1))
        # both meshes differ from finer ones by the same sign, so the error of the ratio is that of the difference
        error = abs(low.error / low.number - high.error / high.number) / log(1.1 / 0.9)
        out[what] = Value(log(high.number / low.number) / log(1.1 / 0.9), error)
    return out


def judge(runs: Runs) -> Judgement:
    """Signs and order at both pressures."""
    holds, parts, notes = [], [], []
    for pressure in PRESSURES:
        values = _sensitivities(runs, pressure)
        order = sorted(SIGNS, key=lambda name: -abs(values[name].number))
        holds += [values[name].number * sign > 0 for name, sign in SIGNS.items()] + [order == list(SIGNS)]
        parts.append(f"at {pressure} kPa " + ", ".join(f"{name} {value}" for name, value in values.items()))
        notes.append(f"At {pressure} kPa the order is {', '.join(order)}.")
        wrong = [name for name, sign in SIGNS.items() if values[name].number * sign <= 0]
        notes += [f"Against the rule, more {name} has the other sign." for name in wrong]
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"d ln(angle) / d ln(parameter): {'; '.join(parts)}. Angles of the reference: "
        + listed([angle_at(runs["reference"].response, pressure) for pressure in PRESSURES]),
        conditions=" ".join(notes),
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves with a tenth more, and the sensitivities."""
    shown = {name: each for name, each in runs.items() if not name.endswith("0.9")}
    lines = [line_of(list(SIGNS), list(_sensitivities(runs, p).values()), f"{p} kPa") for p in PRESSURES]
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=tuple((n, e.response) for n, e in shown.items())),
        tg.pictures.Panel(x="parameter", y="d ln(angle) / d ln(parameter)", lines=lines),
    )


GUIDELINE = Guideline(
    key="7.3-1",
    rule="Omnidirectional actuators bend more with, in order of importance, a thinner wall, a larger length, a larger "
    "chamber diameter and a smaller central diameter.",
    sources=("Yan et al. 2016", "Xie et al. 2018"),
    families=("omnidirectional_actuator", "three_extenders"),
    studies=(
        GuidelineTest(
            title="One parameter at a time",
            setup=SETUP
            + "; wall outside the chambers, length, diameter of the chambers and of the circle that they leave "
            "free in the middle changed by a tenth each, the outer radius following.",
            expected="Signs -, +, +, - and sizes in this order.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
        GuidelineTest(
            title="All combinations, analysis of variance",
            setup=SETUP + "; the same four parameters a tenth less and more in all sixteen combinations.",
            expected="Signs -, +, +, - and shares of the sum of squares in this order.",
            runs=corner_runs,
            judge=judge_corners,
            panels=corner_panels,
        ),
    ),
)
