"""Claim 8.1-6: the skin that fixes the fibers, which models leave out, shifts the pressure by some 25 %."""

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.judging import line_of
from turgor_guidelines.modeling.benders import pressures_of, rubber_of, threads
from turgor_guidelines.values import Value

#: Thickness of the skin [mm]; the publication does not state it here. Stretches at which pressures are compared.
SKINS, STRETCHES = (0.0, 0.25, 0.5, 1.0), (1.1, 1.3)

#: Shifts of the pressure that count as the published 25 %, for some usual skin.
PUBLISHED = (0.15, 0.35)


def extend(skin: float, wall: float) -> Computed:
    """Extend a tube with hoops below a skin [mm], both of Ecoflex 00-30."""
    actuator = tg.actuators.FiberReinforcedCylinder(inner_radius=6.35 * mm, wall=wall * mm, skin=skin * mm)
    wound = threads("winding" if skin else "outside", 90, 0.5, 1.0)
    pressure = np.linspace(0, 12 + 6 * skin, 41)[1:] * kPa * wall / 2
    result = tg.formulas.wound_tube(actuator, rubber_of("ecoflex-00-30/yeoh-kulkarni-2015"), wound, pressure)
    return Computed(response=pressures_of(result["pressure"], result["axial_stretch"], result.source))


def runs(setting: Setting) -> tuple[Run, ...]:
    """Skins below and above the usual one, on a thin and on a thick wall; formulas are cheap."""
    del setting
    return tuple(
        Run(name=f"wall {wall:g} mm, skin {skin:g} mm", function=extend, values={"skin": skin, "wall": wall})
        for wall in (2.0, 4.0)
        for skin in SKINS
    )


def _shift(runs: Runs, wall: float, stretch: float) -> dict[float, float]:
    """Pressure that is needed more, by skin."""
    pressures = {}
    for skin in SKINS:
        response = runs[f"wall {wall:g} mm, skin {skin:g} mm"].response
        reached = response["stretch"][-1] >= stretch
        pressures[skin] = float(np.interp(stretch, response["stretch"], response["pressure"])) if reached else np.nan
    return {skin: pressures[skin] / pressures[0.0] - 1 for skin in SKINS[1:]}


def judge(runs: Runs) -> Judgement:
    """Whether some skin shifts the pressure by the published amount, and that all shift it up."""
    shifts = {(wall, stretch): _shift(runs, wall, stretch) for wall in (2.0, 4.0) for stretch in STRETCHES}
    low, high = PUBLISHED
    up = all(value > 0 for row in shifts.values() for value in row.values())
    near = [
        f"{skin:g} mm on {wall:g} mm"
        for (wall, s), row in shifts.items()
        for skin, v in row.items()
        if low < v < high and s == STRETCHES[0]
    ]
    verdict = Verdict.CONDITIONAL if up and near else Verdict.NOT_REPRODUCED
    if up and all(low < value < high for row in shifts.values() for value in row.values()):
        verdict = Verdict.CONFIRMED
    summary = "; ".join(
        f"wall {wall:g} mm, stretch {stretch:g}: " + ", ".join(f"{skin:g} mm {v:+.0%}" for skin, v in row.items())
        for (wall, stretch), row in shifts.items()
    )
    return Judgement(
        verdict=verdict,
        finding=f"pressure that is needed more with a skin; {summary}",
        conditions=f"The shift follows the thickness of the skin against the wall; about 25 % needs "
        f"{' or '.join(near)}."
        if near
        else "",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves, and the shift against the skin."""
    curves = tuple((name, each.response) for name, each in runs.items() if name.startswith("wall 2"))
    lines = []
    for wall in (2.0, 4.0):
        for stretch in STRETCHES:
            row = _shift(runs, wall, stretch)
            values = [Value(100 * value) for value in row.values()]
            lines.append(line_of(list(row), values, f"wall {wall:g} mm, stretch {stretch:g}"))
    return (
        tg.pictures.Panel(x="pressure", y="stretch", responses=curves),
        tg.pictures.Panel(x="skin [mm]", y="more pressure [%]", lines=lines),
    )


GUIDELINE = Guideline(
    key="8.1-6",
    rule="The extra layer of silicone that fixes the fibers, left out in models, makes them overestimate the "
    "motion; a shift "
    "of the pressure by 25 % matches a test.",
    sources=("Decroly et al. 2019",),
    families=("fiber_reinforced_cylinder",),
    studies=(
        GuidelineTest(
            title="Skin over the hoops",
            setup="Long tube with hoops, inner radius 6.35 mm, wall 2 or 4 mm, skin of 0 to 1 mm over the hoops, "
            "all of Ecoflex "
            "00-30 (Yeoh, Kulkarni), closed ends, by formula. Pressures for stretches of 1.1 and 1.3.",
            expected="More pressure with a skin, by 15 to 35 %.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
