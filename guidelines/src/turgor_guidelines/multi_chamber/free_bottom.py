"""Guideline 7.4-8: PneuNets with a free bottom bend and push more than conventional ones."""

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import change, line_of, verdict_of
from turgor_guidelines.multi_chamber.pneunets import SETUP, bend, count_and_size, pneunet, push, run_of
from turgor_guidelines.values import Value, at

#: Pressures at which angles and forces are compared [kPa].
PRESSURES, PUSH = (4, 9), 12

#: Ranges around the published gains that count as reproduced: of the angle 20 %, of the force 40 %.
RANGES = {"angle": (0.10, 0.35), "force": (0.20, 0.60)}

#: Widths of the strips that join the chambers along each side [mm]; the publication has no number here.
STRIPS = {"quick": (2, 6), "full": (2, 4, 6)}


def runs(setting: Setting) -> tuple[Run, ...]:
    """The conventional one, and free bottoms with strips of several widths, bent and pushing."""
    count, _ = count_and_size(setting)
    given = {"conventional": pneunet(count)}
    for strip in STRIPS[setting]:
        given[f"free, strips {strip} mm"] = pneunet(count, {"bonded_side": strip}, "FreeBottomPneuNet")
    return tuple(
        run_of(f"{what}{name}", function, setting, pressure, {"given": each})
        for what, function, pressure in (("", bend, PRESSURES[-1]), ("pushing, ", push, PUSH))
        for name, each in given.items()
    )


def _gains(runs: Runs) -> dict[str, dict[str, float]]:
    """Relative gain over the conventional one by quantity and name."""
    names = [*(f"angle at {p} kPa" for p in PRESSURES), f"force at {PUSH} kPa"]
    values: dict[str, dict[str, Value]] = {name: {} for name in names}
    for name, each in runs.items():
        if name.startswith("pushing, "):
            force = at(each.response, "blocked_force", "pressure", PUSH * kPa)
            values[f"force at {PUSH} kPa"][name.removeprefix("pushing, ")] = force
        else:
            for p in PRESSURES:
                values[f"angle at {p} kPa"][name] = at(each.response, "bending_angle", "pressure", p * kPa)
    return {
        what: {name: change(value, row["conventional"]) for name, value in row.items() if name != "conventional"}
        for what, row in values.items()
    }


def judge(runs: Runs) -> Judgement:
    """All gains have the sign of the publication; for confirmation they lie in the range around its numbers too."""
    gains = _gains(runs)
    more = [gain > 0 for row in gains.values() for gain in row.values()]
    inside = []
    for what, row in gains.items():
        low, high = RANGES[what.split()[0]]
        inside += [low <= gain <= high for gain in row.values()]
    summary = "; ".join(
        f"{what} " + ", ".join(f"{gain:+.1%} ({name})" for name, gain in row.items()) for what, row in gains.items()
    )
    fewer = [what for what, row in gains.items() if min(row.values()) <= 0]
    conditions = "How large the gain is depends on the strips that join the chambers, on the pressure, and on what the "
    conditions += "conventional one has between its chambers."
    if fewer:
        conditions += f" There is a loss here: {', '.join(fewer)}."
    return Judgement(
        verdict=verdict_of(more) if not all(more) else verdict_of([True, *inside]),
        finding=summary,
        conditions=conditions,
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Angles, forces, and gains against the width of the strips."""
    bent = tuple((name, each.response) for name, each in runs.items() if "bending_angle" in each.response)
    pushed = tuple((name, each.response) for name, each in runs.items() if "blocked_force" in each.response)
    lines = [
        line_of([float(name.split()[-2]) for name in row], [Value(100 * gain) for gain in row.values()], what)
        for what, row in _gains(runs).items()
    ]
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=bent),
        tg.pictures.Panel(x="pressure", y="blocked_force", responses=pushed),
        tg.pictures.Panel(x="width of the strips [mm]", y="gain over the conventional one [%]", lines=lines),
    )


GUIDELINE = Guideline(
    key="7.4-8",
    rule="Free-bottom actuators, whose chambers are free between the outer sides, bend about 20 % more and push 40 % "
    "harder than conventional ones.",
    sources=("Yang et al. 2020",),
    families=("free_bottom_pneunet", "fast_pneunet"),
    studies=(
        GuidelineTest(
            title="Free bottom or common floor",
            setup="Fast "
            + SETUP.format(count="of two chambers (four at the full setting)")
            + "; without the floor between the chambers but for strips along the sides, the channel hanging free. "
            "Angles "
            "at 4 and 9 kPa, force of the tip on a plate at 12 kPa.",
            expected="Angle 10 to 35 % larger, force 20 to 60 % larger.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
