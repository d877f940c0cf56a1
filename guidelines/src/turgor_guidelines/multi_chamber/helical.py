"""Guideline 7.4-9: slanted chambers bend less, twist more and push harder; the length only adds loops."""

from itertools import pairwise

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.multi_chamber.pneunets import PITCH, SETUP, bend, count_and_size, pneunet, push, run_of
from turgor_guidelines.values import Value, at, falls, listed, rises

#: Pressures of bending, before walls touch, and of pushing [kPa].
PRESSURE, PUSH = 6, 12

#: Angles of the chambers [deg].
ANGLES = {"quick": (0, 15, 30), "full": (0, 10, 20, 30)}

#: Numbers of chambers; how far angle and twist for each added chamber may differ.
COUNTS, SAME = {"quick": (2, 3, 4), "full": (3, 4, 5, 6)}, 0.1


def _given(angle: float, count: int) -> dict[str, float]:
    return pneunet(count, {"chamber_angle": angle}, "HelicalPneuNet")


def runs(setting: Setting) -> tuple[Run, ...]:
    """Chambers of several angles, bent; the straight and the most slanted ones pushing too."""
    count, _ = count_and_size(setting)
    bent = [
        run_of(f"{angle} deg", bend, setting, PRESSURE, {"given": _given(angle, count)}) for angle in ANGLES[setting]
    ]
    ends = (ANGLES[setting][0], ANGLES[setting][-1])
    pushing = [run_of(f"{angle} deg, pushing", push, setting, PUSH, {"given": _given(angle, count)}) for angle in ends]
    return (*bent, *pushing)


def longer(setting: Setting) -> tuple[Run, ...]:
    """The same chambers, more of them."""
    return tuple(
        run_of(f"{count} chambers", bend, setting, PRESSURE, {"given": _given(15, count), "mesh_error": False})
        for count in COUNTS[setting]
    )


def _read(runs: Runs, name: str) -> list[Value]:
    bent = [each.response for each in runs.values() if name in each.response]
    values = [at(each, name, "pressure", PRESSURE * kPa) for each in bent]
    return [Value(abs(value.number), value.error, value.unit) for value in values]


def judge(runs: Runs) -> Judgement:
    """Angle, twist and force against the angle of the chambers."""
    angle, twist = _read(runs, "bending_angle"), _read(runs, "twist_angle")
    forces = [
        at(e.response, "blocked_force", "pressure", PUSH * kPa) for e in runs.values() if "blocked_force" in e.response
    ]
    holds = {"less bending": falls(angle), "more twist": rises(twist), "more force": rises(forces)}
    missed = [name for name, confirmed in holds.items() if not confirmed]
    return Judgement(
        verdict=verdict_of(holds.values()),
        finding=f"chambers at {', '.join(name for name in runs if 'pushing' not in name)}: bending {listed(angle)} "
        f"and twist "
        f"{listed(twist)} at {PRESSURE} kPa; force at {PUSH} kPa, first and last, {listed(forces)}",
        conditions=f"Not seen here: {', '.join(missed)}." if missed else "",
    )


def judge_longer(runs: Runs) -> Judgement:
    """Each further chamber adds the same angle and the same twist, so that radius and pitch stay."""
    parts, holds = [], []
    for name in ("bending_angle", "twist_angle"):
        values = [value.number for value in _read(runs, name)]
        added = [b - a for a, b in pairwise(values)]
        spread = max(added) / min(added) - 1
        holds.append(0 <= spread < SAME)
        parts.append(
            f"{name.replace('_', ' ')} {listed(_read(runs, name))}, each chamber adds {spread:.1%} more or less"
        )
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"{', '.join(runs)} at {PRESSURE} kPa: {'; '.join(parts)}",
        conditions="" if all(holds) else "Ends of the actuator still matter with so few chambers.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves, and angle and twist against the angle of the chambers."""
    bent = {name: each.response for name, each in runs.items() if "bending_angle" in each.response}
    curves = tuple(bent.items())
    x = [float(name.split()[0]) for name in bent]
    lines = [line_of(x, _read(runs, f"{name}_angle"), name) for name in ("bending", "twist")]
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=curves),
        tg.pictures.Panel(x="pressure", y="twist_angle", responses=curves),
        tg.pictures.Panel(
            x="number of chambers" if "chambers" in next(iter(runs)) else "angle of the chambers [deg]",
            y=f"angles at {PRESSURE} kPa [deg]",
            lines=lines,
        ),
    )


GUIDELINE = Guideline(
    key="7.4-9",
    rule="Helical multi-chambered actuators push harder than bending ones; a larger chamber angle bends less and "
    "twists "
    "more; the length does not change radius and pitch of the winding, only the number of loops.",
    sources=("Hu and Alici 2020",),
    families=("helical_pneunet",),
    studies=(
        GuidelineTest(
            title="Angle of the chambers",
            setup="Fast "
            + SETUP.format(count="of two chambers (four at the full setting)")
            + "; chambers turned about the vertical. Bending and twist of the tip at 6 kPa, force of the tip on a "
            "plate at "
            "12 kPa.",
            expected="Bending falls with the angle of the chambers, twist and force rise.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
        GuidelineTest(
            title="Length",
            setup=f"The same with chambers turned by 15 deg, one chamber every {PITCH} mm, more and more of them, "
            f"at 6 kPa.",
            expected="Every further chamber adds the same angle and the same twist, within 10 %.",
            runs=longer,
            judge=judge_longer,
            panels=panels,
        ),
    ),
)
