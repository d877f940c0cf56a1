"""Guideline 7.0-3: density and angle of the wrapping have a high impact on fiber-reinforced actuators."""

from turgor.units import deg, kPa, mm
from turgor_guidelines.fiber_reinforced import density, single_wrap
from turgor_guidelines.fiber_reinforced.banded import SETUP
from turgor_guidelines.fiber_reinforced.wound import TUBE
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Verdict
from turgor_guidelines.values import at, last

#: Change of the extension that counts as a high impact: that of a wall of half the thickness.
HIGH = 2.0


def judge_density(runs: Runs) -> Judgement:
    """Largest over smallest extension, at half and at full pressure."""
    names = list(runs)
    ratio = {}
    for pressure in (density.PRESSURE / 5, density.PRESSURE):
        lengths = [density.extension(runs, name, pressure).number for name in names]
        ratio[pressure] = max(lengths) / min(lengths)
    volumes = [density.injected(runs[name].response).number for name in names]
    high = [each > HIGH for each in ratio.values()]
    return Judgement(
        verdict=Verdict.CONFIRMED if all(high) else Verdict.CONDITIONAL if any(high) else Verdict.NOT_REPRODUCED,
        finding="From no hoops to one every 2 mm the extension changes "
        + ", ".join(f"{each:.2f} times at {pressure:g} kPa" for pressure, each in ratio.items())
        + f", the injected volume {max(volumes) / min(volumes):.2f} times at {density.PRESSURE:g} kPa.",
        conditions="The impact on the stroke is largest at small pressure; near the limit point the bare tube "
        "catches up, and the impact is one on the volume.",
    )


def judge_angle(runs: Runs) -> Judgement:
    """Range of extension, expansion and twist over the angles, at full pressure."""
    stretch, wide, twist = (
        [last(each.response, name).number for each in runs.values()]
        for name in ("stretch", "outside_ballooning", "twist")
    )
    top = max(stretch) - 1
    signs = min(stretch) < 1 < max(stretch)
    small = [at(each.response, "stretch", "pressure", single_wrap.PRESSURES[0] * kPa).number for each in runs.values()]
    high = max(abs(each) for each in twist) > 0 and top / max(min(stretch) - 1, 1e-12) > HIGH
    return Judgement(
        verdict=Verdict.CONFIRMED if high else Verdict.NOT_REPRODUCED,
        finding=f"Over the angles of a single helix at {single_wrap.PRESSURES[-1]:g} kPa, the stretch goes from "
        f"{min(stretch):.4f} to {max(stretch):.4f}, the outer radius from {min(wide):.3f} to {max(wide):.3f} times, "
        f"the twist from 0 to {max(abs(each) for each in twist) / deg * mm:.3g} deg/mm.",
        conditions=f"{'Some angles shorten the tube' if signs else 'No angle shortens the tube'} at full pressure; at "
        f"{single_wrap.PRESSURES[0]:g} kPa the stretch goes from {min(small):.4f} to {max(small):.4f}.",
    )


GUIDELINE = Guideline(
    key="7.0-3",
    rule="For fiber-reinforced actuators, the density and the angle of the wrapping have a high impact.",
    sources=("Xavier, Fleming and Yong 2021",),
    families=("fiber_reinforced_cylinder", "twisting_tube"),
    studies=(
        GuidelineTest(
            title="Density of hoops",
            setup=f"{SETUP}; extension at 10 and at 50 kPa.",
            expected="The extension changes more than twice from no hoops to one every 2 mm.",
            runs=density.runs,
            judge=judge_density,
            panels=density.panels,
        ),
        GuidelineTest(
            title="Angle of a single helix",
            setup=f"{TUBE}, one right-handed helix with 2 mm between threads, at 0 to 90 deg from the circumference.",
            expected="The extension changes more than twice, and some angles twist.",
            runs=single_wrap.runs,
            judge=judge_angle,
            panels=single_wrap.panels,
        ),
    ),
)
