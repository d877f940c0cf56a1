"""Guideline 7.2-8: braids extend above 54.7° and contract below; two sides with different angles bend."""

import numpy as np

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.fiber_reinforced import two_sides
from turgor_guidelines.fiber_reinforced.wound import TUBE, cells, tube
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.values import at

#: The neutral angle from the axis [deg], its tolerance, and pressures [kPa].
NEUTRAL, NEAR, PRESSURES = 54.7356, 0.5, (6.25, 31.25, 62.5)

#: Angles from the axis [deg]; distances between threads [mm], dense and so loose that the wall counts.
ANGLES, SPACINGS = (40.0, 50.0, 54.0, 55.5, 60.0, 70.0), (2.0, 256.0)


def runs(setting: Setting) -> tuple[Run, ...]:
    """A double winding at each angle, dense and loose."""
    size = cells(setting)
    return tuple(
        Run(
            name=f"{angle:g} deg, {'dense' if spacing == SPACINGS[0] else 'loose'}",
            function=tube,
            values={"from_axis": angle, "spacing": spacing, "hand": "both", "pressure": PRESSURES[-1], "size": size},
        )
        for spacing in SPACINGS
        for angle in ANGLES
    )


def longer(runs: Runs, kind: str, pressure: float) -> tuple[list[float], list[float]]:
    """Angles, and stretch less 1 at a pressure [kPa]."""
    chosen = {name: each for name, each in runs.items() if name.endswith(kind)}
    angles = [float(name.split()[0]) for name in chosen]
    return angles, [at(each.response, "stretch", "pressure", pressure * kPa).number - 1 for each in chosen.values()]


def neutral(angles: list[float], change: list[float]) -> float:
    """Angle at which the length stays; not a number where it does not change its sign once."""
    signs = np.sign(change)
    turns = np.flatnonzero(signs[1:] != signs[:-1])
    if len(turns) != 1:
        return np.nan
    k = int(turns[0])
    return float(angles[k] - change[k] * (angles[k + 1] - angles[k]) / (change[k + 1] - change[k]))


def judge(runs: Runs) -> Judgement:
    """Where the sign of the extension changes, at three pressures and for two densities."""
    where = {
        (kind, pressure): neutral(*longer(runs, kind, pressure))
        for kind in ("dense", "loose")
        for pressure in PRESSURES
    }
    dense = [where["dense", pressure] for pressure in PRESSURES]
    contracts = longer(runs, "dense", PRESSURES[-1])[1][0] < 0
    close = [abs(each - NEUTRAL) < NEAR for each in dense]
    verdict = Verdict.CONFIRMED if all(close) and contracts else Verdict.NOT_REPRODUCED
    summary = ", ".join(f"{where['dense', p]:.2f} deg at {p:g} kPa" for p in PRESSURES)
    loose = ", ".join(f"{where['loose', p]:.2f} deg" if np.isfinite(where["loose", p]) else "none" for p in PRESSURES)
    return Judgement(
        verdict=verdict,
        finding=f"The length stays at {summary} from the axis, 2 mm between threads.",
        conditions=f"Angles count from the axis; from the circumference the neutral angle is {90 - NEUTRAL:.1f} "
        f"deg. It belongs to threads that do not stretch: with so few that they do (256 mm apart) it is {loose} at "
        "the same pressures.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Stretch against the angle, for dense and loose threads."""
    drawn = []
    for kind in ("dense", "loose"):
        lines = []
        for pressure in PRESSURES:
            angles, change = longer(runs, kind, pressure)
            lines.append(tg.pictures.Line(x=angles, y=[each + 1 for each in change], label=f"{kind}, {pressure:g} kPa"))
        drawn.append(tg.pictures.Panel(x="angle from the axis [deg]", y="stretch [-]", lines=lines))
    return tuple(drawn)


SIDES = (
    "Section of a long tube (inner radius 6.35 mm, outer 8.35 mm, closed ends), Elastosil M4601 (neo-Hookean, C10 = "
    "0.12 MPa), double windings of Kevlar thread of 0.1778 mm every 2 mm, at one angle on the upper half and another "
    "on the lower half, from the axis; curvature, and moment that holds it straight, at 30 kPa"
)

GUIDELINE = Guideline(
    key="7.2-8",
    rule="McKibben actuators with a braid angle above 54.7 deg extend, others contract. A greater difference between "
    "the braid angles of both sides gives more bending and force at the same pressure; 70 deg with 35 deg bend most.",
    sources=("Wang et al. 2016", "Nordin et al. 2013"),
    families=("contracting_tube", "fiber_reinforced_cylinder"),
    studies=(
        GuidelineTest(
            title="Neutral angle of a braid",
            setup=f"{TUBE}, both hands, 2 mm apart and 256 mm apart; stretch at three pressures.",
            expected="The stretch crosses 1 within 0.5 deg of 54.7 deg from the axis; below it the tube contracts.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
        GuidelineTest(
            title="Difference of the braid angles of both sides",
            setup=f"{SIDES}.",
            expected="With one angle fixed, curvature and moment rise with every step to a greater difference.",
            runs=two_sides.runs,
            judge=two_sides.judge_difference,
            panels=two_sides.panels,
        ),
        GuidelineTest(
            title="70 deg with 35 deg against other pairs",
            setup=f"{SIDES}.",
            expected="Of all pairs, 70 deg with 35 deg bend most.",
            runs=two_sides.runs,
            judge=two_sides.judge_named,
            panels=two_sides.panels,
        ),
    ),
)
