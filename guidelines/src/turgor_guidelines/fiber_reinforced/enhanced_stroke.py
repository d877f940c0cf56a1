"""Guideline 7.2-2: fibers give more extension or bending for less fluid, and lose less energy in radial expansion."""

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa, mm
from turgor_guidelines.fiber_reinforced.banded import SETUP
from turgor_guidelines.fiber_reinforced.density import PRESSURE, along, extension, panels, runs
from turgor_guidelines.fiber_reinforced.wound import BENDER, bender, cells
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.values import at

#: Pressures at which tubes and benders are compared [kPa].
TUBES, BENDERS = (10.0, 20.0, 30.0, 40.0, PRESSURE), (4.0, 8.0, 20.0, 40.0)

#: Extension of the tubes at which the injected volumes are compared [m].
EXTENSION = 4 * mm


def judge_tubes(runs: Runs) -> Judgement:
    """Extension at equal pressure, and volume at equal extension."""
    names = list(runs)
    bare, dense = names[0], names[-1]
    pairs = [(extension(runs, bare, p), extension(runs, dense, p)) for p in TUBES]
    ahead = [wound.number - plain.number > wound.error + plain.error for plain, wound in pairs]
    share = []
    for name in (bare, dense):
        response = runs[name].response
        rest = response["cavity_volume"][0]
        share.append(along(response, "cavity_volume", "tip_displacement_x", EXTENSION) / rest - 1)
    less = share[0] > share[1]
    verdict = Verdict.CONFIRMED if all(ahead) and less else Verdict.CONDITIONAL
    if not any(ahead) or not less:
        verdict = Verdict.NOT_REPRODUCED
    text = "; ".join(f"{p:g} kPa {a} and {b}" for p, (a, b) in zip(TUBES, pairs, strict=True))
    behind = [f"{p:g}" for p, each in zip(TUBES, ahead, strict=True) if not each]
    return Judgement(
        verdict=verdict,
        finding=f"Extension without hoops and with {dense}: {text}. Volume for {EXTENSION / mm:g} mm: {share[0]:.1%} "
        f"and {share[1]:.1%} of that at rest.",
        conditions=(
            "With hoops the tube is ahead at all pressures. "
            if not behind
            else f"The tube without hoops is ahead at {', '.join(behind)} kPa: near its limit point it lengthens as "
            "fast as it balloons. "
        )
        + "The volume for the same stroke is smaller with hoops throughout." * bool(less),
    )


def bent(setting: Setting) -> tuple[Run, ...]:
    """The bender without hoops and with hoops."""
    size = cells(setting)
    return tuple(
        Run(name=name, function=bender, values={"spacing": spacing, "pressure": 40.0, "size": size})
        for name, spacing in (("no hoops", 0.0), ("hoops every 2 mm", 2.0))
    )


def judge_benders(runs: Runs) -> Judgement:
    """Curvature at equal pressure, and volume at equal curvature."""
    bare, wound = (each.response for each in runs.values())
    pairs = [tuple(at(each, "curvature_y", "pressure", p * kPa) for each in (bare, wound)) for p in BENDERS]
    ahead = [b.number - a.number > a.error + b.error for a, b in pairs]
    bend = float(bare["curvature_y"][-1])
    volumes = [along(each, "cavity_volume_per_length", "curvature_y", bend) for each in (bare, wound)]
    grown = [
        volume / each["cavity_volume_per_length"][0] - 1 for volume, each in zip(volumes, (bare, wound), strict=True)
    ]
    text = "; ".join(f"{p:g} kPa {a} and {b}" for p, (a, b) in zip(BENDERS, pairs, strict=True))
    return Judgement(
        verdict=Verdict.CONFIRMED if all(ahead) and grown[1] < grown[0] else Verdict.NOT_REPRODUCED,
        finding=f"Curvature without and with hoops: {text}. Volume for {bend:.3g} 1/m: {grown[0]:.1%} and "
        f"{grown[1]:.1%} more than at rest.",
        conditions=f"The factor falls from {pairs[1][1].number / pairs[1][0].number:.3g} at {BENDERS[1]:g} kPa to "
        f"{pairs[-1][1].number / pairs[-1][0].number:.3g} at {BENDERS[-1]:g} kPa: without hoops bending grows with the "
        "square of the pressure, with hoops less than in proportion to it.",
    )


def bender_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature against pressure, and volume against curvature."""
    curves = tuple((name, each.response) for name, each in runs.items())
    lines = [
        tg.pictures.Line(
            x=each.response["curvature_y"],
            y=100 * (each.response["cavity_volume_per_length"] / each.response["cavity_volume_per_length"][0] - 1),
            label=name,
        )
        for name, each in runs.items()
    ]
    return (
        tg.pictures.Panel(x="pressure", y="curvature_y", responses=curves),
        tg.pictures.Panel(x="curvature y [1/m]", y="injected volume [% of that at rest]", lines=lines),
    )


GUIDELINE = Guideline(
    key="7.2-2",
    rule="Fiber-reinforced actuators have a larger extension or bending stroke, need less fluid, and lose less energy "
    "in the radial expansion of the rubber.",
    sources=("Zhang et al. 2019", "Xavier, Fleming and Yong 2019"),
    families=("fiber_reinforced_cylinder", "fiber_reinforced_bender"),
    studies=(
        GuidelineTest(
            title="Extension of tubes with and without hoops",
            setup=f"{SETUP}; extension up to 50 kPa, and volume for 4 mm of it.",
            expected="At every pressure the tube with hoops extends further, for less volume.",
            runs=runs,
            judge=judge_tubes,
            panels=panels,
        ),
        GuidelineTest(
            title="Bending of a half-round section with and without hoops",
            setup=f"{BENDER}, or without these hoops; curvature up to 40 kPa.",
            expected="At every pressure the bender with hoops bends further, for less volume.",
            runs=bent,
            judge=judge_benders,
            panels=bender_panels,
        ),
    ),
)
