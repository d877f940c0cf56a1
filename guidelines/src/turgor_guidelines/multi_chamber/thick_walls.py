"""Guideline 7.4-6: thicker walls between chambers bend less and push less."""

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.multi_chamber.pneunets import MULTI_CHAMBERED, SETUP, bend, count_and_size, pneunet, push, run_of
from turgor_guidelines.values import Value, at, falls, last, listed

#: Pressures of bending, of which the first is before walls touch, and of pushing [kPa].
PRESSURES, PUSH = (4, 14), 12

#: Thickness of the walls between chambers [mm].
WALLS = {"quick": (1.5, 2.25, 3.0), "full": (0.75, 1.0, 1.5, 2.25, 3.0)}


def runs(setting: Setting) -> tuple[Run, ...]:
    """Bent, and pushing, with walls of each thickness."""
    count, _ = count_and_size(setting)
    changed = {wall: pneunet(count, {} if wall == 1.5 else {"wall": wall}) for wall in WALLS[setting]}
    return tuple(
        run_of(f"{what} {wall:g} mm", function, setting, pressure, {"given": given})
        for what, function, pressure in (("bent,", bend, PRESSURES[-1]), ("pushing,", push, PUSH))
        for wall, given in changed.items()
    )


def _split(runs: Runs) -> tuple[list[float], dict[int, list[Value]], list[Value]]:
    """Walls [mm], angles at each pressure, and forces."""
    bent = {name: each.response for name, each in runs.items() if name.startswith("bent")}
    forces = [last(each.response, "blocked_force") for name, each in runs.items() if name.startswith("pushing")]
    walls = [float(name.split()[1]) for name in bent]
    angles = {p: [at(each, "bending_angle", "pressure", p * kPa) for each in bent.values()] for p in PRESSURES}
    return walls, angles, forces


def judge(runs: Runs) -> Judgement:
    """Angles and forces fall."""
    walls, angles, forces = _split(runs)
    text = "; ".join(f"angle at {p} kPa {listed(values)}" for p, values in angles.items())
    holds = {f"the angle at {p} kPa": falls(values) for p, values in angles.items()} | {"the force": falls(forces)}
    missed = [name for name, confirmed in holds.items() if not confirmed]
    return Judgement(
        verdict=verdict_of(holds.values()),
        finding=f"walls of {', '.join(f'{wall:g}' for wall in walls)} mm: {text}; force at {PUSH} kPa {listed(forces)}",
        conditions=f"Does not fall by more than the mesh error: {', '.join(missed)}." if missed else "",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves, and the angle and the force against the wall."""
    walls, angles, forces = _split(runs)
    bent = tuple((name.split(", ")[1], each.response) for name, each in runs.items() if name.startswith("bent"))
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=bent),
        tg.pictures.Panel(
            x="wall between chambers [mm]",
            y="bending angle [deg]",
            lines=[line_of(walls, values, f"{p} kPa") for p, values in angles.items()],
        ),
        tg.pictures.Panel(x="wall between chambers [mm]", y=f"force at {PUSH} kPa [N]", lines=[line_of(walls, forces)]),
    )


GUIDELINE = Guideline(
    key="7.4-6",
    rule="For a fixed length, thicker chamber walls result in lower bending and lower output force.",
    sources=("Mosadegh et al. 2014", "Sun et al. 2013", "Yang et al. 2020"),
    families=MULTI_CHAMBERED,
    studies=(
        GuidelineTest(
            title="Wall between chambers",
            setup="Fast "
            + SETUP.format(count="of two chambers (four at the full setting)")
            + "; walls between chambers of other thickness take from the chambers. Angles at 4 and 14 kPa, force of "
            "the "
            "tip on a plate at 12 kPa.",
            expected="Angle and force fall with the thickness.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
