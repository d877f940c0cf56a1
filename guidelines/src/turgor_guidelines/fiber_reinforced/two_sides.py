"""Tubes whose upper and lower half are wound at different angles: how far they bend, and what holds them straight."""

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.fiber_reinforced.wound import cells
from turgor_guidelines.guideline import Judgement, Runs, Setting, Verdict
from turgor_guidelines.parts import elastosil, threads
from turgor_guidelines.pictures import outline_of
from turgor_guidelines.sections import COARSER, compared
from turgor_guidelines.values import Value, largest, last, rises

#: Angles from the axis of the upper and of the lower half [deg], and the pressure [kPa].
UPPER = {"quick": (55, 70, 90), "full": (55, 60, 65, 70, 75, 80, 85, 90)}
LOWER = {"quick": (0, 20, 35, 45, 55), "full": (0, 10, 20, 25, 30, 35, 40, 45, 50, 55)}
PRESSURE = 30.0

#: The pair that the rule names [deg].
NAMED = (70.0, 35.0)


def bend(upper: float, lower: float, size: float) -> Computed:
    """Inflate a tube with double windings at these angles from the axis [deg], free and at zero curvature."""

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
        free = section.solve(pressures, prescribed={"twist": 0.0, "curvature_z": 0.0}, throw=False, mesh_error=False)
        still = section.solve(
            pressures, prescribed={"twist": 0.0, "curvature_z": 0.0, "curvature_y": 0.0}, throw=False, mesh_error=False
        )
        rows = min(len(free.response), len(still.response))
        columns = [tg.experiments.Column(each.name, each.unit, each.values[:rows]) for each in free.response.columns]
        columns.append(tg.experiments.Column("blocked_moment", "Nm", -still.response["moment_y"][:rows]))
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


def _rows(runs: Runs, name: str) -> dict[float, list[Value]]:
    """A column by the upper angle, over falling lower angles: over rising differences."""
    out: dict[float, list[Value]] = {}
    for key in sorted(runs, key=lambda each: -pair(each)[1]):
        out.setdefault(pair(key)[0], []).append(last(runs[key].response, name))
    return out


def _best(runs: Runs, name: str) -> dict[float, tuple[float, bool]]:
    """For each upper angle, the lower one of the largest value, and whether that is the greatest difference."""
    out = {}
    for upper, values in _rows(runs, name).items():
        lowers = _lowers(runs, upper)
        out[upper] = lowers[largest(values)], rises(values)
    return out


def _lowers(runs: Runs, upper: float) -> list[float]:
    """Lower angles of an upper one, over rising differences."""
    return sorted((pair(name)[1] for name in runs if pair(name)[0] == upper), reverse=True)


def judge_difference(runs: Runs) -> Judgement:
    """Whether curvature and moment rise with the difference of the angles while one of them stays."""
    bends, moments = (_best(runs, name) for name in ("curvature_y", "blocked_moment"))
    throughout = all(rising for each in (bends, moments) for _, rising in each.values())
    at_first = all(lower < _lowers(runs, upper)[0] for each in (bends, moments) for upper, (lower, _) in each.items())
    parts = [
        f"upper {upper:g} deg with lower {', '.join(f'{each:g}' for each in _lowers(runs, upper))} deg: curvature "
        f"{', '.join(f'{each.number:.3g}' for each in values)} 1/m, moment that holds it straight "
        f"{', '.join(f'{1e3 * each.number:.3g}' for each in _rows(runs, 'blocked_moment')[upper])} mNm"
        for upper, values in _rows(runs, "curvature_y").items()
    ]
    top = max(runs, key=lambda name: last(runs[name].response, "curvature_y").number)
    verdict = Verdict.CONDITIONAL if at_first else Verdict.NOT_REPRODUCED
    return Judgement(
        verdict=Verdict.CONFIRMED if throughout else verdict,
        finding=f"{'; '.join(parts)}. All at {PRESSURE:g} kPa.",
        conditions="More difference bends further only up to a point: "
        + "; ".join(
            f"with {upper:g} deg above, bending is largest at {lower:g} deg below, the moment at "
            f"{moments[upper][0]:g} deg"
            for upper, (lower, _) in bends.items()
        )
        + f". Of all pairs {top} bends most. Threads nearly along the axis let the lower half balloon, so that it "
        "shortens no more.",
    )


def judge_named(runs: Runs) -> Judgement:
    """Where 70 deg with 35 deg stands among all pairs, with both ways to count the angles."""
    ranked = sorted(runs, key=lambda name: -last(runs[name].response, "curvature_y").number)
    named = {pair(name): last(runs[name].response, "curvature_y") for name in runs}
    place = [pair(name) for name in ranked].index(NAMED) + 1
    other = tuple(sorted((90 - each for each in NAMED), reverse=True))
    below, moment = (_best(runs, name)[NAMED[0]][0] for name in ("curvature_y", "blocked_moment"))
    partly = NAMED[1] in (below, moment)
    verdict = Verdict.CONDITIONAL if partly else Verdict.NOT_REPRODUCED
    return Judgement(
        verdict=Verdict.CONFIRMED if place == 1 else verdict,
        finding=f"70/35 deg from the axis: curvature {named[NAMED]} at {PRESSURE:g} kPa, place {place} of "
        f"{len(ranked)} pairs; most: {ranked[0]} with {last(runs[ranked[0]].response, 'curvature_y')}. Counted from "
        f"the circumference the same pair is {other[0]:g}/{other[1]:g} deg from the axis"
        + (f", {named[other]}." if other in named else ", which was not computed."),
        conditions=f"With 70 deg above, {below:g} deg below bends most, and {moment:g} deg has the largest moment; "
        "hoops above (90 deg) bend further than 70 deg with every lower angle that was tried."
        if all(named[90.0, low].number > each.number for (up, low), each in named.items() if up == NAMED[0])
        else f"With 70 deg above, {below:g} deg below bends most, and {moment:g} deg has the largest moment.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature and moment against the lower angle, a line for each upper angle."""
    drawn = []
    for name, label in (("curvature_y", "curvature [1/m]"), ("blocked_moment", "moment that holds it straight [Nm]")):
        lines = []
        for upper, values in _rows(runs, name).items():
            lowers = sorted((pair(key)[1] for key in runs if pair(key)[0] == upper), reverse=True)
            error = [each.error for each in values]
            numbers = [each.number for each in values]
            lines.append(tg.pictures.Line(x=lowers, y=numbers, error=error, label=f"upper half at {upper:g} deg"))
        drawn.append(tg.pictures.Panel(x="angle of the lower half from the axis [deg]", y=label, lines=lines))
    return tuple(drawn)
