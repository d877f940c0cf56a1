"""Tubes whose upper and lower half are wound at different angles: how far they bend, and what holds them straight."""

import numpy as np

import turgor as tg
from turgor.guidelines.drawn import outline_of
from turgor.guidelines.fiber_reinforced.wound import cells
from turgor.guidelines.guideline import Found, Judgement, Setting, Verdict
from turgor.guidelines.parts import elastosil, threads
from turgor.guidelines.sections import COARSER, compared
from turgor.guidelines.values import Value, largest, last, rises
from turgor.response import Column
from turgor.results.plots.study_figure import Line, Panel
from turgor.study.runs import Computed, Run
from turgor.units import kPa, mm

#: Angles from the axis of the upper and of the lower half [deg], and the pressure [kPa].
UPPER = {"quick": (55, 70, 90), "full": (55, 60, 65, 70, 75, 80, 85, 90)}
LOWER = {"quick": (0, 20, 35, 45, 55), "full": (0, 10, 20, 25, 30, 35, 40, 45, 50, 55)}
PRESSURE = 30.0

#: The pair that the rule names [deg].
NAMED = (70.0, 35.0)


def bend(upper: float, lower: float, size: float) -> Computed:
    """Inflate a tube with double windings at these angles from the axis [deg], free and held straight."""

    def solve(cell: float) -> tuple[tg.Response, tg.sections.SectionSolution]:
        section = tg.Section(
            tg.actuators.FiberReinforcedCylinder(symmetric=False),
            {"body": elastosil()},
            reinforcements=[
                threads(from_axis=angle, hand="both", above=above) for angle, above in ((upper, True), (lower, False))
            ],
            size=cell,
        )
        pressures = np.linspace(0, PRESSURE * kPa, 7)
        free = section.solve(pressures, held={"twist": 0.0, "curvature_z": 0.0}, throw=False)
        still = section.solve(pressures, held={"twist": 0.0, "curvature_z": 0.0, "curvature_y": 0.0}, throw=False)
        rows = min(len(free.response), len(still.response))
        columns = [Column(each.name, each.unit, each.values[:rows]) for each in free.response.columns]
        columns.append(Column("blocked_moment", "Nm", -still.response["moment_y"][:rows]))
        return tg.Response(columns=tuple(columns), source=free.response.source), free

    (fine, free), (coarse, _) = solve(size * mm), solve(COARSER * size * mm)
    return Computed(response=compared(fine, coarse), picture=outline_of(free))


def runs(setting: Setting) -> tuple[Run, ...]:
    """All pairs of angles whose upper one is larger."""
    size = cells(setting)
    return tuple(
        Run(name=f"{upper}/{lower} deg", function=bend, values={"upper": upper, "lower": lower, "size": size})
        for upper in UPPER[setting]
        for lower in LOWER[setting]
        if upper > lower
    )


def pair(name: str) -> tuple[float, float]:
    """Angles of a run by its name: upper, lower [deg]."""
    upper, lower = name.split()[0].split("/")
    return float(upper), float(lower)


def _rows(found: Found, name: str) -> dict[float, list[Value]]:
    """A column by the upper angle, over falling lower angles: over rising differences."""
    out: dict[float, list[Value]] = {}
    for key in sorted(found, key=lambda each: -pair(each)[1]):
        out.setdefault(pair(key)[0], []).append(last(found[key].response, name))
    return out


def judge_difference(found: Found) -> Judgement:
    """Whether curvature and moment rise with the difference of the angles while one of them stays."""
    told, good, best = [], [], []
    for upper, bends in _rows(found, "curvature_y").items():
        lowers = sorted((pair(name)[1] for name in found if pair(name)[0] == upper), reverse=True)
        moments = _rows(found, "blocked_moment")[upper]
        good += [rises(bends), rises(moments)]
        best.append(lowers[largest(bends)])
        told.append(
            f"upper {upper:g} deg with lower {', '.join(f'{each:g}' for each in lowers)} deg: curvature "
            f"{', '.join(f'{each.number:.3g}' for each in bends)} 1/m, moment that holds it straight "
            f"{', '.join(f'{1e3 * each.number:.3g}' for each in moments)} mNm"
        )
    top = max(found, key=lambda name: last(found[name].response, "curvature_y").number)
    verdict = Verdict.CONFIRMED if all(good) else Verdict.CONDITIONAL if any(good) else Verdict.NOT_REPRODUCED
    return Judgement(
        verdict=verdict,
        found="; ".join(told) + f". All at {PRESSURE:g} kPa.",
        conditions=f"The largest difference of all, {max(abs(np.subtract(*pair(name))) for name in found):g} deg, "
        f"does not decide alone: {top} bends most. With the upper angle kept, bending is largest at a lower angle of "
        f"{', '.join(f'{each:g}' for each in best)} deg: what counts is how much the upper half would lengthen and the "
        "lower half shorten, and threads nearly along the axis let the lower half balloon.",
    )


def judge_named(found: Found) -> Judgement:
    """Where 70 deg with 35 deg stands among all pairs, with both ways to count the angles."""
    ranked = sorted(found, key=lambda name: -last(found[name].response, "curvature_y").number)
    from_axis, other = NAMED, tuple(sorted((90 - each for each in NAMED), reverse=True))
    bends = {pair(name): last(found[name].response, "curvature_y") for name in found}
    place = [pair(name) for name in ranked].index(from_axis) + 1
    hoops = {lower: value for (upper, lower), value in bends.items() if upper == from_axis[0]}
    top = max(hoops, key=lambda lower: hoops[lower].number)
    first = place == 1
    verdict = Verdict.CONFIRMED if first else Verdict.CONDITIONAL if top == from_axis[1] else Verdict.NOT_REPRODUCED
    return Judgement(
        verdict=verdict,
        found=f"70/35 deg from the axis: curvature {bends[from_axis]} at {PRESSURE:g} kPa, place {place} of "
        f"{len(ranked)} pairs; most: {ranked[0]} with {last(found[ranked[0]].response, 'curvature_y')}. Counted from the "
        f"circumference the same pair is {other[0]:g}/{other[1]:g} deg from the axis"
        + (f", {bends[other]}." if other in bends else ", which was not computed."),
        conditions=f"Of the pairs with 70 deg, a lower angle of {top:g} deg bends most; of all pairs {ranked[0]}. "
        "Angles count from the axis.",
    )


def panels(found: Found) -> tuple[Panel, ...]:
    """Curvature and moment against the lower angle, a line for each upper angle."""
    drawn = []
    for name, label in (("curvature_y", "curvature [1/m]"), ("blocked_moment", "moment that holds it straight [Nm]")):
        lines = []
        for upper, values in _rows(found, name).items():
            lowers = sorted((pair(key)[1] for key in found if pair(key)[0] == upper), reverse=True)
            error = [each.error for each in values]
            numbers = [each.number for each in values]
            lines.append(Line(x=lowers, y=numbers, error=error, label=f"upper half at {upper:g} deg"))
        drawn.append(Panel(x="angle of the lower half from the axis [deg]", y=label, lines=lines))
    return tuple(drawn)
