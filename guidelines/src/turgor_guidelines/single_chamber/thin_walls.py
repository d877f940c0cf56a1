"""Guideline 7.1-3: thinner walls bend and extend further."""

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.parts import elastosil, threads
from turgor_guidelines.pictures import picture_of
from turgor_guidelines.single_chamber.half_round import BARE, BENDER, HOOPED, bend, cells
from turgor_guidelines.values import at, last, listed, rises

#: Outer radius of the tubes and their walls [mm]; pressures of tubes and benders [kPa].
OUTER, TUBES, TUBE_PRESSURE, BENDER_PRESSURE = 8.35, (3.0, 2.5, 2.0, 1.5, 1.0), 50.0, 20.0

#: Walls of the benders [mm], and what stays when they get thinner.
WALLS, VOID, OUTSIDE = (3.0, 2.0, 1.5), "void kept", "outside kept"


def extend(wall: float, size: float) -> Computed:
    """Extend a tube in hoops with a wall [mm], in cells of a size [mm]."""
    shape = tg.actuators.FiberReinforcedCylinder(inner_radius=(OUTER - wall) * mm, wall=wall * mm, length=60 * mm)
    model = tg.Model(
        tg.mesh(shape.build(), size=size * mm, cells="axisymmetric"),
        {"body": elastosil()},
        [tg.Fixed("fixed")],
        [tg.Pressure("cavity", TUBE_PRESSURE * kPa)],
        reinforcements=[threads()],
    )
    solution = tg.solve(model, throw=False)
    return Computed(response=tg.measure(solution, tg.measures.tip_displacement_x), picture=picture_of(solution))


def tube_runs(setting: Setting) -> tuple[Run, ...]:
    """Tubes whose inner radius grows."""
    size = 2.0 if setting == "quick" else 1.0
    return tuple(Run(name=f"wall {wall:g} mm", function=extend, values={"wall": wall, "size": size}) for wall in TUBES)


def judge_tubes(runs: Runs) -> Judgement:
    """Thinner wall, longer tube."""
    lengths = [at(each.response, "tip_displacement_x", "pressure", TUBE_PRESSURE * kPa) for each in runs.values()]
    return Judgement(
        verdict=Verdict.CONFIRMED if rises(lengths) else Verdict.NOT_REPRODUCED,
        finding=f"{', '.join(runs)}: extension {listed(lengths)} at {TUBE_PRESSURE:g} kPa.",
        conditions=f"The extension grows {lengths[-1].number / lengths[0].number:.1f} times while the wall becomes "
        f"{TUBES[0] / TUBES[-1]:g} times thinner: the outside stays, so that the pressure also acts on a larger area.",
    )


def tube_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Extension against pressure, and against the wall."""
    lengths = [last(each.response, "tip_displacement_x") for each in runs.values()]
    line = tg.pictures.Line(
        x=[float(name.split()[1]) for name in runs],
        y=[each.number for each in lengths],
        error=[each.error for each in lengths],
    )
    curves = tuple((name, each.response) for name, each in runs.items())
    return (
        tg.pictures.Panel(x="pressure", y="tip_displacement_x", responses=curves),
        tg.pictures.Panel(x="wall [mm]", y=f"extension at {TUBE_PRESSURE:g} kPa [mm]", lines=[line]),
    )


def bender_runs(setting: Setting) -> tuple[Run, ...]:
    """Benders, bare and in hoops, thinner from outside or from inside."""
    return tuple(
        Run(
            name=f"{around}, {fixed}, wall {wall:g} mm",
            function=bend,
            values={
                "radius": 8.0 if fixed == VOID else 10.0 - wall,
                "wall": wall,
                "base": 2.0,
                "hooped": around == HOOPED,
                "pressure": BENDER_PRESSURE,
                "size": cells(setting),
            },
        )
        for around in (BARE, HOOPED)
        for fixed in (VOID, OUTSIDE)
        for wall in WALLS
    )


def _groups(runs: Runs) -> dict[str, list[str]]:
    """Names of runs that differ in their wall only."""
    out: dict[str, list[str]] = {}
    for name in runs:
        out.setdefault(name.rpartition(", ")[0], []).append(name)
    return out


def judge_benders(runs: Runs) -> Judgement:
    """Thinner wall, larger curvature, in each of four ways."""
    parts, good = [], {}
    for group, names in _groups(runs).items():
        bends = [last(runs[name].response, "curvature_y") for name in names]
        good[group] = rises(bends)
        parts.append(f"{group}: {listed(bends)}")
    verdict = Verdict.CONFIRMED if all(good.values()) else Verdict.CONDITIONAL
    bad = [group for group, each in good.items() if not each]
    return Judgement(
        verdict=verdict if any(good.values()) else Verdict.NOT_REPRODUCED,
        finding=f"Curvature at {BENDER_PRESSURE:g} kPa with walls of {', '.join(f'{each:g}' for each in WALLS)} mm: "
        + "; ".join(parts)
        + ".",
        conditions=f"It does not hold with {' and '.join(bad)}."
        if bad
        else "It holds bare and in hoops, whether the void or the outside stays the same.",
    )


def bender_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature against pressure, and against the wall."""
    lines = []
    for group, names in _groups(runs).items():
        bends = [last(runs[name].response, "curvature_y") for name in names]
        lines.append(
            tg.pictures.Line(
                x=[float(name.split()[-2]) for name in names],
                y=[each.number for each in bends],
                error=[each.error for each in bends],
                label=group,
            )
        )
    names = [name for name in runs if VOID in name]
    return (
        tg.pictures.Panel(
            x="pressure", y="curvature_y", responses=tuple((name, runs[name].response) for name in names)
        ),
        tg.pictures.Panel(x="wall [mm]", y=f"curvature at {BENDER_PRESSURE:g} kPa [1/m]", lines=lines),
    )


EXTENDERS = GuidelineTest(
    title="Wall of a tube in hoops",
    setup="Whole tube (outer radius 8.35 mm, 60 mm long, caps of 5 mm, one end fixed), axisymmetric, Elastosil M4601 "
    "(neo-Hookean, C10 = 0.12 MPa), hoops of Kevlar thread every 2 mm, smeared; extension at 50 kPa.",
    expected="The extension rises with every step to a thinner wall.",
    runs=tube_runs,
    judge=judge_tubes,
    panels=tube_panels,
)

BENDERS = GuidelineTest(
    title="Wall of a half-round bender",
    setup=f"{BENDER}; walls of 3, 2 and 1.5 mm around a chamber of 8 mm radius, or inside an outer radius of 10 mm, "
    "base of 2 mm; curvature at 20 kPa.",
    expected="The curvature rises with every step to a thinner wall.",
    runs=bender_runs,
    judge=judge_benders,
    panels=bender_panels,
)

GUIDELINE = Guideline(
    key="7.1-3",
    rule="Actuators with thinner walls show larger bending angles and extensions.",
    sources=("Polygerinos et al. 2015", "Zhang et al. 2019"),
    families=("extending_cylinder", "fiber_reinforced_cylinder", "semicircular_bender", "fiber_reinforced_bender"),
    studies=(EXTENDERS, BENDERS),
)
