"""Guideline 7.2-6: one helix extends most at 0°, expands most at 90°, twists most near 30° from the circumference."""

import numpy as np

import turgor as tg
from turgor.studies import Run
from turgor.units import deg, kPa, mm
from turgor_guidelines.fiber_reinforced.wound import TUBE, cells, tube
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.values import Value, at, largest, listed

#: Angles from the circumference [deg], and pressures at which they are compared [kPa].
QUICK, FULL = (0, 15, 25, 30, 35, 45, 60, 90), (0, 10, 20, 25, 30, 35, 40, 45, 60, 75, 90)
PRESSURES = (6.25, 31.25, 62.5)

#: Angles around 30° that still count as such [deg], and how little a tube with threads along it may lengthen.
NEAR, NO_EXTENSION = (25.0, 35.0), 0.003


def runs(setting: Setting) -> tuple[Run, ...]:
    """A tube for each angle of a single helix."""
    return tuple(
        Run(
            name=f"{angle} deg",
            function=tube,
            values={
                "from_axis": 90.0 - angle,
                "spacing": 2.0,
                "hand": "right",
                "pressure": PRESSURES[-1],
                "size": cells(setting),
            },
        )
        for angle in (QUICK if setting == "quick" else FULL)
    )


def angles_of(runs: Runs) -> list[float]:
    """Angles from the circumference, by the names of the runs."""
    return [float(name.split()[0]) for name in runs]


def optimum(angles: list[float], values: list[float]) -> float:
    """Angle of the largest value: the top of a parabola through the largest one and its neighbors."""
    top = int(np.argmax(values))
    if top in (0, len(values) - 1):
        return angles[top]
    a, b, _ = np.polyfit(angles[top - 1 : top + 2], values[top - 1 : top + 2], 2)
    return float(-b / (2 * a))


def values_at(runs: Runs, name: str, pressure: float) -> list[Value]:
    """A column of every run at a pressure [kPa]."""
    return [at(each.response, name, "pressure", pressure * kPa) for each in runs.values()]


def judge(runs: Runs) -> Judgement:
    """Where extension, expansion and twist are largest, at three pressures."""
    angles, parts, longest, widest, most = angles_of(runs), [], [], [], []
    for pressure in PRESSURES:
        stretch, radius = (values_at(runs, name, pressure) for name in ("stretch", "outside_ballooning"))
        twist = [abs(each.number) for each in values_at(runs, "twist", pressure)]
        longest.append(angles[largest(stretch)])
        widest.append(angles[largest(radius)])
        most.append(optimum(angles, twist))
        parts.append(
            f"at {pressure:g} kPa longest at {longest[-1]:g} deg (stretch {stretch[largest(stretch)]}), widest at "
            f"{widest[-1]:g} deg ({radius[largest(radius)]} times), most twist at {most[-1]:.1f} deg "
            f"({max(twist) / deg * mm:.3g} deg/mm)"
        )
    axial = [at(list(runs.values())[-1].response, "stretch", "pressure", p * kPa) for p in PRESSURES]
    ends = all(angle == 0 for angle in longest) and abs(axial[-1].number - 1) < NO_EXTENSION
    near = [NEAR[0] <= angle <= NEAR[1] for angle in most]
    wide = [angle == angles[-1] for angle in widest]
    verdict = Verdict.CONFIRMED if ends and all(near) and all(wide) else Verdict.CONDITIONAL
    if not ends or not any(near):
        verdict = Verdict.NOT_REPRODUCED
    return Judgement(
        verdict=verdict,
        finding=f"{'; '.join(parts)}. Stretch with threads at {angles[-1]:g} deg: {listed(axial)}.",
        conditions="Angles count from the circumference; from the axis the rule would be wrong in every part. The "
        f"angle of most twist goes from {most[0]:.1f} to {most[-1]:.1f} deg ({90 - most[0]:.1f} to "
        f"{90 - most[-1]:.1f} deg from the axis) while the pressure goes from {PRESSURES[0]:g} to {PRESSURES[-1]:g} "
        "kPa. Expansion is largest "
        + ("at 90 deg at all pressures." if all(wide) else f"at {', '.join(f'{each:g}' for each in widest)} deg."),
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Stretch, radius and twist against the angle."""
    angles = angles_of(runs)
    drawn = []
    for name, label, scale in (
        ("stretch", "stretch [-]", 1.0),
        ("outside_ballooning", "outer radius, now over before [-]", 1.0),
        ("twist", "size of the twist [deg/mm]", mm / deg),
    ):
        lines = [
            tg.pictures.Line(
                x=angles,
                y=[abs(each.number) * scale for each in values_at(runs, name, pressure)],
                error=[each.error * scale for each in values_at(runs, name, pressure)],
                label=f"{pressure:g} kPa",
            )
            for pressure in PRESSURES
        ]
        drawn.append(tg.pictures.Panel(x="angle from the circumference [deg]", y=label, lines=lines))
    return tuple(drawn)


ANGLES = GuidelineTest(
    title="Angle of a single helix, at three pressures",
    setup=f"{TUBE}, one right-handed helix with 2 mm between threads; stretch, outer radius and twist.",
    expected="The tube is longest at 0 deg, widest at 90 deg where its stretch stays within 0.3 % of 1, and twists "
    "most at 25 to 35 deg, at every pressure.",
    runs=runs,
    judge=judge,
    panels=panels,
)

GUIDELINE = Guideline(
    key="7.2-6",
    rule="With a single fiber wrap, axial extension is largest at a fiber angle of 0 deg, radial expansion at 90 deg, "
    "where there is no extension, and twist near 30 deg.",
    sources=("Connolly et al. 2015",),
    families=("twisting_tube", "fiber_reinforced_cylinder"),
    studies=(ANGLES,),
)
