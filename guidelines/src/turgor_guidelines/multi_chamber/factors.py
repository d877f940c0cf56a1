"""Guideline 7.4-3: the bottom matters most for the angle, then the walls between chambers, then the gap."""

from collections.abc import Mapping

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.factorials import analyses, corner_name, corners, share_lines, shares_text
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import change, line_of, verdict_of
from turgor_guidelines.multi_chamber.pneunets import MULTI_CHAMBERED, SETUP, bend, count_and_size, pneunet, run_of
from turgor_guidelines.values import Value, at, listed

#: Pressures at which angles are compared: before walls touch and after [kPa].
PRESSURES = (4, 14)

#: Factors of every dimension.
GROWTH = {"quick": (1.5,), "full": (0.75, 1.5)}

#: Names of the factors in the expected order, and the other way of a thicker wall.
ORDER = ("bottom", "wall", "gap")
LONGER = "wall, chambers kept"


def _changed(what: str, factor: float, count: int) -> dict[str, float]:
    """Dimensions [mm] for one factor; the height grows with the bottom, the length with the gap."""
    length = pneunet(count)["length"]
    more = factor - 1
    return {
        "bottom": {"base": 1.5 * factor, "floor": 1.5 * factor, "height": 19 + 3 * more},
        "wall": {"wall": 1.5 * factor},
        LONGER: {"wall": 1.5 * factor, "length": length + 2 * (count - 1) * 1.5 * more},
        "gap": {"gap": factor, "length": length + (count - 1) * more},
    }[what]


def runs(setting: Setting) -> tuple[Run, ...]:
    """The reference, and each dimension changed."""
    count, _ = count_and_size(setting)
    changed = [
        run_of(
            f"{what} x {factor:g}",
            bend,
            setting,
            PRESSURES[-1],
            {"given": pneunet(count, _changed(what, factor, count))},
        )
        for factor in GROWTH[setting]
        for what in (*ORDER, LONGER)
    ]
    return (run_of("reference", bend, setting, PRESSURES[-1]), *changed)


def corner_runs(setting: Setting) -> tuple[Run, ...]:
    """All combinations of dimensions a tenth less and more."""
    count, _ = count_and_size(setting)
    return tuple(
        run_of(corner_name(scales), bend, setting, PRESSURES[-1], {"given": pneunet(count, _corner(scales, count))})
        for scales in corners(ORDER)
    )


def _corner(scales: Mapping[str, float], count: int) -> dict[str, float]:
    """Dimensions [mm] of a corner: those that one factor alone changes, added up."""
    rest = pneunet(count)
    out: dict[str, float] = {}
    for what, factor in scales.items():
        for name, value in _changed(what, factor, count).items():
            out[name] = out.get(name, rest[name]) + value - rest[name]
    return out


def judge_corners(runs: Runs) -> Judgement:
    """Signs of the effects, and the order of their shares of the variance."""
    tables = analyses(runs, ORDER, PRESSURES)
    holds = [each.effect(name) < 0 for each in tables.values() for name in ORDER]
    holds += [each.ranking == ORDER for each in tables.values()]
    notes = [f"At {pressure} kPa the order is {', '.join(each.ranking)}." for pressure, each in tables.items()]
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"shares of the sum of squares; {shares_text(tables)}",
        conditions=" ".join(notes),
    )


def corner_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Shares of the variance."""
    lines = share_lines(analyses(runs, ORDER, PRESSURES))
    return (tg.pictures.Panel(x="dimension", y="share of the sum of squares [%]", lines=lines),)


def _angles(runs: Runs, pressure: float) -> dict[str, Value]:
    """Angles [deg] at a pressure [kPa]."""
    return {name: at(each.response, "bending_angle", "pressure", pressure * kPa) for name, each in runs.items()}


def _effects(runs: Runs, pressure: float) -> dict[str, float]:
    angles = _angles(runs, pressure)
    rest = angles.pop("reference")
    return {name: change(each, rest) for name, each in angles.items()}


def judge(runs: Runs) -> Judgement:
    """Signs, and the order of the sizes, before walls touch and after."""
    largest = max(float(name.split(" x ")[1]) for name in runs if " x " in name)
    holds, parts, notes = [], [], []
    for pressure in PRESSURES:
        effects = {
            name.split(" x ")[0]: size for name, size in _effects(runs, pressure).items() if f"x {largest:g}" in name
        }
        sizes = [abs(effects[name]) for name in ORDER]
        holds += [effects[name] < 0 for name in ORDER] + [sizes == sorted(sizes, reverse=True)]
        parts.append(f"{pressure} kPa: " + ", ".join(f"{name} {size:+.1%}" for name, size in effects.items()))
        order = sorted(ORDER, key=lambda name: -abs(effects[name]))
        signs = [f"a larger {name} bends further" for name in ORDER if effects[name] >= 0]
        notes.append(f"At {pressure} kPa the order is {', '.join(order)}" + "".join(f", and {each}" for each in signs))
        notes[-1] += (
            f"; where the chambers keep their length, thicker walls change the angle by {effects[LONGER]:+.1%}."
        )
    angles = listed(list(_angles(runs, PRESSURES[-1]).values()))
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"change of the angle with dimensions {largest:g} times as large; {'; '.join(parts)}. Angles: {angles}",
        conditions=" ".join(notes),
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves, and effects at both pressures."""
    curves = tuple((name, each.response) for name, each in runs.items())
    lines = []
    for pressure in PRESSURES:
        effects = _effects(runs, pressure)
        sizes = [Value(100 * size) for size in effects.values()]
        lines.append(line_of(list(effects), sizes, f"{pressure} kPa"))
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=curves),
        tg.pictures.Panel(x="dimension", y="change of the angle [%]", lines=lines),
    )


GUIDELINE = Guideline(
    key="7.4-3",
    rule="Most influence on the bending angle has the thickness of the bottom, then that of the walls, then the gap; "
    "smaller gaps bend further.",
    sources=("Hu et al. 2018",),
    families=MULTI_CHAMBERED,
    studies=(
        GuidelineTest(
            title="Bottom, wall and gap half as large again",
            setup="Fast "
            + SETUP.format(count="of two chambers (four at the full setting)")
            + "; floor and base, walls between chambers, or gap are larger; thicker walls once take from the "
            "chambers and "
            "once make the actuator longer. Angles at 4 and 14 kPa.",
            expected="All three reduce the angle, in this order.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
        GuidelineTest(
            title="All combinations, analysis of variance",
            setup="Fast "
            + SETUP.format(count="of two chambers (four at the full setting)")
            + "; bottom, walls and gap a tenth less and more in all eight combinations. Angles at 4 and 14 kPa.",
            expected="All three reduce the angle, with shares of the sum of squares in this order.",
            runs=corner_runs,
            judge=judge_corners,
            panels=corner_panels,
        ),
    ),
)
