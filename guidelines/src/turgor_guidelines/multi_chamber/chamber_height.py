"""Guideline 7.4-7: higher chambers push harder."""

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import change, line_of, verdict_of
from turgor_guidelines.multi_chamber.pneunets import (
    MULTI_CHAMBERED,
    SETUP,
    WALLS,
    count_and_size,
    pneunet,
    push,
    run_of,
)
from turgor_guidelines.values import at, listed, rises

#: Pressures at which forces are compared: low, and high [kPa].
PRESSURES = (3, 12)

#: Heights of the actuator [mm], 5 mm more than those of the chambers.
HEIGHTS = {"quick": (15, 19, 23), "full": (13, 15, 17, 19, 23)}


def runs(setting: Setting) -> tuple[Run, ...]:
    """Pushing on a plate with chambers of each height; that of 19 mm is shared with other guidelines."""
    count, _ = count_and_size(setting)
    changed = {
        height: pneunet(count, {} if height == WALLS["height"] else {"height": height}) for height in HEIGHTS[setting]
    }
    return tuple(
        run_of(f"{height:g} mm", push, setting, PRESSURES[-1], {"given": given}) for height, given in changed.items()
    )


def judge(runs: Runs) -> Judgement:
    """The force rises with the height, at both pressures."""
    forces = {p: [at(each.response, "blocked_force", "pressure", p * kPa) for each in runs.values()] for p in PRESSURES}
    holds = {p: rises(values) for p, values in forces.items()}
    missed = [f"{p} kPa" for p, confirmed in holds.items() if not confirmed]
    gains = ", ".join(f"{change(values[-1], values[0]):+.0%} at {p} kPa" for p, values in forces.items())
    return Judgement(
        verdict=verdict_of(holds.values()),
        finding=f"height {', '.join(runs)}: "
        + "; ".join(f"{listed(values)} at {p} kPa" for p, values in forces.items()),
        conditions=f"From the lowest to the highest the force changes by {gains}."
        + (f" It does not rise at every step at {', '.join(missed)}." if missed else ""),
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Force against pressure, and against the height."""
    curves = tuple((name, each.response) for name, each in runs.items())
    heights = [float(name.split()[0]) for name in runs]
    lines = [
        line_of(
            heights,
            [at(each.response, "blocked_force", "pressure", p * kPa) for each in runs.values()],
            f"{p} kPa",
        )
        for p in PRESSURES
    ]
    return (
        tg.pictures.Panel(x="pressure", y="blocked_force", responses=curves),
        tg.pictures.Panel(x="height [mm]", y="force on the plate [N]", lines=lines),
    )


GUIDELINE = Guideline(
    key="7.4-7",
    rule="Increased chamber height leads to increased force output.",
    sources=("Polygerinos et al. 2013",),
    families=MULTI_CHAMBERED,
    studies=(
        GuidelineTest(
            title="Height of the chambers",
            setup="Fast "
            + SETUP.format(count="of two chambers (four at the full setting)")
            + "; other heights at the same walls; force of the tip on a plate that stands where it is at rest, at 3 "
            "and "
            "12 kPa.",
            expected="The force rises with the height.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
