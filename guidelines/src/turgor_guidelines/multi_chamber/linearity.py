"""Guideline 7.4-1: many chambers respond in a straighter line than a single void, because they bulge less."""

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import verdict_of
from turgor_guidelines.multi_chamber.pneunets import SETUP, at_angle, bend, count_and_size, pneunet, run_of
from turgor_guidelines.values import last, linearity, listed

#: Angle up to which all bend and at which they are compared [deg for each chamber], and pressures that reach it [kPa].
ANGLE = 5
PRESSURES = {"fast, chambers": 20, "slow, chambers": 80, "single void": 60}


def runs(setting: Setting) -> tuple[Run, ...]:
    """Chambers with gaps, chambers without, and one chamber as long as all of them."""
    count, _ = count_and_size(setting)
    length = {"length": pneunet(count)["length"]}
    given = (pneunet(count), pneunet(count, {}, "SlowPneuNet"), pneunet(1, length, "SlowPneuNet"))
    return tuple(
        run_of(name, bend, setting, PRESSURES[name], {"given": each, "until": ANGLE * count})
        for name, each in zip(PRESSURES, given, strict=True)
    )


def judge(runs: Runs) -> Judgement:
    """Straightness up to the same angle, and how far the sides have bulged there."""
    reached = min(last(each.response, "bending_angle").number for each in runs.values())
    angle = 0.999 * reached
    straight, bulges = [], []
    for each in runs.values():
        pressure = at_angle(each.response, "pressure", angle).number * kPa
        straight.append(linearity(each.response, "bending_angle", "pressure", pressure))
        bulges.append(at_angle(each.response, "bulge", angle))
    fast, slow, void = straight
    fits = ", ".join(f"{name} {value:.4f}" for name, value in zip(runs, straight, strict=True))
    return Judgement(
        verdict=verdict_of(
            [fast > void, slow > void, bulges[0].number < bulges[2].number, bulges[1].number < bulges[2].number]
        ),
        finding=f"R² of a straight line up to {angle:.3g} deg: {fits}; sides bulge by {listed(bulges)} there, in this "
        f"order",
        conditions=_conditions(straight, [each.number for each in bulges]),
    )


def _conditions(straight: list[float], bulges: list[float]) -> str:
    parts = []
    for k, name in enumerate(("With gaps", "Without gaps")):
        line = "straighter" if straight[k] > straight[2] else "less straight"
        parts.append(f"{name} the line is {line} than that of a single void, and the sides bulge {_times(bulges, k)}.")
    return " ".join(parts)


def _times(bulges: list[float], k: int) -> str:
    ratio = bulges[k] / bulges[2]
    return f"{1 / ratio:.2g} times less" if ratio < 1 else f"{ratio:.2g} times more"


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Angle and bulge against pressure and angle."""
    curves = tuple((name, each.response) for name, each in runs.items())
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=curves),
        tg.pictures.Panel(x="bending_angle", y="bulge", responses=curves),
    )


GUIDELINE = Guideline(
    key="7.4-1",
    rule="Multi-chambered actuators respond more linearly than a single void, because they resist radial extension.",
    sources=("Mosadegh et al. 2014", "Hwang et al. 2015"),
    families=("fast_pneunet", "slow_pneunet"),
    studies=(
        GuidelineTest(
            title="Chambers or a single void in the same envelope",
            setup="Fast and slow "
            + SETUP.format(count="of two chambers (four at the full setting)")
            + ", and one void in the same envelope; R² of a straight line through angle over pressure up to the same "
            "angle, and the largest displacement of the sides there.",
            expected="R² is larger with chambers, and the sides bulge less.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
