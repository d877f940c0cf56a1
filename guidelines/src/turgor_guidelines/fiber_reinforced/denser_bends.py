"""Guideline 7.2-5: denser wrapping bends further and makes the response less nonlinear."""

from itertools import pairwise

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.fiber_reinforced.wound import BENDER, bender, cells
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.values import last, linearity, listed, rises
from turgor_guidelines.wear import lives, tearing

#: Last pressure [kPa], and distances between hoops [mm], 0 for none.
PRESSURE, SPACINGS = 40.0, (0.0, 512.0, 128.0, 32.0, 8.0, 2.0)

#: Growth of the curvature from one density to the next that is still worth a winding.
WORTH = 0.02


def runs(setting: Setting) -> tuple[Run, ...]:
    """Benders from no hoops to one every 2 mm."""
    return tuple(
        Run(
            name=f"every {spacing:g} mm" if spacing else "no hoops",
            function=bender,
            values={"spacing": spacing, "pressure": PRESSURE, "size": cells(setting)},
        )
        for spacing in SPACINGS
    )


def density(name: str) -> float:
    """Threads on 100 mm, by the name of a run."""
    return 0.0 if name == "no hoops" else 100 / float(name.split()[1])


def judge(runs: Runs) -> Judgement:
    """Curvature, R², stretch and tearing energy over the density."""
    names = list(runs)
    bends = [last(each.response, "curvature_y") for each in runs.values()]
    straight = [linearity(each.response, "curvature_y", "pressure", PRESSURE * kPa) for each in runs.values()]
    stretched = [last(each.response, "principal_stretch_p99") for each in runs.values()]
    gains = [b.number / a.number - 1 for a, b in pairwise(bends)]
    enough = next((names[k] for k, gain in enumerate(gains) if gain < WORTH), names[-1])
    further, straighter = rises(bends), straight == sorted(straight)
    torn = [tearing(each.number) for each in stretched]
    spared = torn == sorted(torn, reverse=True)
    verdict = Verdict.CONFIRMED if further and straighter and spared else Verdict.CONDITIONAL
    if bends[-1].number <= bends[0].number:
        verdict = Verdict.NOT_REPRODUCED
    best = names[straight.index(max(straight))]
    return Judgement(
        verdict=verdict,
        finding=f"{', '.join(names)}: curvature {listed(bends)} at {PRESSURE:g} kPa; R² "
        f"{', '.join(f'{each:.4f}' for each in straight)}; stretch that 99 % of the "
        f"rubber stay below {listed(stretched)}, and tearing energy of a flaw of 0.1 mm there "
        f"{', '.join(f'{each:.3g}' for each in torn)} J/m².",
        conditions=f"Wear falls {'with every step' if spared else 'not with every step'}: the densest hoops last "
        f"{lives(torn[-1], torn[0])} as long as none at the same pressure, if cracks grow with the 2nd to 4th power of "
        f"the energy. Beyond hoops {enough} a step of four in density adds less than {WORTH:.0%} to the curvature, "
        "since Kevlar hardly stretches; threads are smeared here, and the wall between them cannot bulge. "
        + (
            "R² rises with the density."
            if straighter
            else f"R² is largest with {best}: without hoops bending grows with the square of the pressure, with stiff "
            "hoops it sets out steeply and slows down, and in between both nearly cancel."
        ),
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature against pressure, and curvature and R² against the density."""
    bends = [last(each.response, "curvature_y") for each in runs.values()]
    x = [density(name) for name in runs]
    line = tg.pictures.Line(x=x, y=[each.number for each in bends], error=[each.error for each in bends])
    straight = [linearity(each.response, "curvature_y", "pressure", PRESSURE * kPa) for each in runs.values()]
    curves = tuple((name, each.response) for name, each in runs.items())
    return (
        tg.pictures.Panel(x="pressure", y="curvature_y", responses=curves),
        tg.pictures.Panel(x="threads on 100 mm", y=f"curvature at {PRESSURE:g} kPa [1/m]", lines=[line]),
        tg.pictures.Panel(
            x="threads on 100 mm", y="R² of a straight line [-]", lines=[tg.pictures.Line(x=x, y=straight)]
        ),
    )


GUIDELINE = Guideline(
    key="7.2-5",
    rule="A higher density of wrapping leads to more bending and reduces the nonlinear behavior that comes from "
    "ballooning, which reduces the wear of the rubber.",
    sources=("Xavier, Fleming and Yong 2019", "Fras and Althoefer 2019"),
    families=("fiber_reinforced_bender",),
    studies=(
        GuidelineTest(
            title="Hoops of a half-round section at six densities",
            setup=f"{BENDER} at distances from 2 mm to 512 mm, or none; curvature up to 40 kPa.",
            expected="Curvature at 40 kPa and R² of a straight line rise with every step to denser hoops, and the "
            "tearing energy of a flaw falls.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
