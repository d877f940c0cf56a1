"""Guideline 7.1-1: softer rubber bends further at low pressure with less stress, and pushes less at its tip."""

from dataclasses import replace

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.parts import fabric, threads
from turgor_guidelines.pictures import outline_of, picture_of
from turgor_guidelines.sections import COARSER, compared
from turgor_guidelines.single_chamber.half_round import cells
from turgor_guidelines.values import Value, at, falls, last, listed, rises

#: Rubbers from soft to hard, all of one group's records.
RUBBERS = {
    "Ecoflex 00-30": ("ecoflex-00-30", "yeoh-polygerinos-2015"),
    "Dragon Skin 10": ("dragon-skin-10", "neo-hooke-polygerinos-2020"),
    "Elastosil M4601": ("elastosil-m4601", "neo-hooke-polygerinos-2020"),
    "Smooth-Sil 950": ("smooth-sil-950", "neo-hooke-polygerinos-2020"),
}

#: Last pressure over the shear modulus; pressure and extension of all [kPa, m]; stretch that a rubber may bear.
LARGEST, PRESSURE, EXTENSION, USABLE = 0.2, 2.5, 3 * mm, 1.5


def _rubber(name: str) -> tg.Material:
    library, record = RUBBERS[name]
    return tg.from_library(library, record=record)


def extend(rubber: str, size: float) -> Computed:
    """Extend a tube in hoops up to a pressure of a share of the modulus, in cells of a size [mm]."""
    material = _rubber(rubber)
    highest = LARGEST * material.law.shear_modulus
    model = tg.Model(
        tg.mesh(tg.actuators.FiberReinforcedCylinder(length=60 * mm).build(), size=size * mm, cells="axisymmetric"),
        {"body": material},
        [tg.Fixed("fixed")],
        [tg.Pressure("cavity", highest)],
        reinforcements=[threads()],
    )
    solution = tg.solve(model, tg.Static(max_step=0.2), throw=False)
    response = tg.measure(solution, tg.measures.tip_displacement_x, tg.measures.von_mises_p99)
    return Computed(response=response, picture=picture_of(solution))


def bend(rubber: str, size: float) -> Computed:
    """Bend a half-round section free and at zero curvature, up to a pressure of twice the share of the modulus."""
    material = _rubber(rubber)
    pressures = np.linspace(0, 2 * LARGEST * material.law.shear_modulus, 13)
    # Rods, not threads that go slack: next to the softest rubber slack threads leave no path from rest.
    wound = [*fabric(), replace(threads(("outside", "strain_limiting_layer")), compression=1.0)]

    def solve(cell: float) -> tuple[tg.Response, tg.sections.SectionSolution]:
        shape = tg.actuators.FiberReinforcedBender(skin=0.0)
        section = tg.Section(shape, {"body": material}, reinforcements=wound, size=cell)
        free = section.solve(pressures, throw=False, mesh_error=False)
        still = section.solve(pressures, prescribed={"curvature_y": 0.0}, throw=False, mesh_error=False).response
        rows = min(len(free.response), len(still))
        columns = [tg.experiments.Column(each.name, each.unit, each.values[:rows]) for each in free.response.columns]
        columns.append(tg.experiments.Column("blocked_moment", "Nm", -still["moment_y"][:rows]))
        return tg.Response(columns=tuple(columns), source=free.response.source), free

    (fine, free), (coarse, _) = solve(size * mm), solve(COARSER * size * mm)
    return Computed(response=compared(fine, coarse), picture=outline_of(free))


def extension_runs(setting: Setting) -> tuple[Run, ...]:
    """Whole tubes of each rubber."""
    size = 2.0 if setting == "quick" else 1.0
    return tuple(Run(name=name, function=extend, values={"rubber": name, "size": size}) for name in RUBBERS)


def bending_runs(setting: Setting) -> tuple[Run, ...]:
    """Sections of each rubber."""
    return tuple(Run(name=name, function=bend, values={"rubber": name, "size": cells(setting)}) for name in RUBBERS)


def judge_stress(runs: Runs) -> Judgement:
    """Extension and stress at equal pressure, stress at equal extension."""
    drives = [each.response for each in runs.values()]
    moves = [at(each, "tip_displacement_x", "pressure", PRESSURE * kPa) for each in drives]
    pressed = [at(each, "von_mises_p99", "pressure", PRESSURE * kPa) for each in drives]
    equal = [at(each, "von_mises_p99", "tip_displacement_x", EXTENSION) for each in drives]
    further, less, at_pressure = falls(moves), rises(equal), rises(pressed)
    verdict = Verdict.CONFIRMED if less and at_pressure else Verdict.CONDITIONAL if less or at_pressure else None
    return Judgement(
        verdict=verdict if further and verdict else Verdict.NOT_REPRODUCED,
        finding=f"{', '.join(runs)}: extension {listed(moves)} and von Mises stress (99 % of the volume) "
        f"{listed(pressed)} at {PRESSURE:g} kPa; stress {listed(equal)} at an extension of {EXTENSION / mm:g} mm.",
        conditions=f"At equal extension the softest has {equal[0].number / equal[-1].number:.0%} of the stress of the "
        f"hardest; at equal pressure it has {pressed[0].number / pressed[-1].number:.0%}: "
        + (
            "there it is not lower, since the pressure sets the stress and the softer wall has become thinner."
            if not at_pressure
            else "lower there as well."
        ),
    )


def judge_force(runs: Runs) -> Judgement:
    """Curvature and blocked moment at equal pressure, and blocked moment where the rubber reaches a stretch."""
    drives = [each.response for each in runs.values()]
    bends = [at(each, "curvature_y", "pressure", PRESSURE * kPa) for each in drives]
    moments = [at(each, "blocked_moment", "pressure", PRESSURE * kPa) for each in drives]
    usable = [_at_stretch(each, "pressure", 1 / kPa, "kPa") for each in drives]
    most = [_at_stretch(each, "blocked_moment", 1e3, "mNm") for each in drives]
    short = [name for name, each in zip(runs, most, strict=True) if not np.isfinite(each.number)]
    if short:
        raise tg.TurgorError(f"the path of {', '.join(short)} ends before a stretch of {USABLE:g}.")
    further, weaker = falls(bends), most == sorted(most, key=lambda each: each.number)
    numbers = [1e3 * each.number for each in moments]
    return Judgement(
        verdict=Verdict.CONFIRMED if further and weaker else Verdict.NOT_REPRODUCED,
        finding=f"{', '.join(runs)}: curvature {listed(bends)} and moment that holds it straight "
        f"{', '.join(f'{each:.3g}' for each in numbers)} mNm at {PRESSURE:g} kPa; the rubber reaches a stretch of "
        f"{USABLE:g} at {listed(usable)}, where the moment is {listed(most)}.",
        conditions=f"The lower force is one of the pressure that the rubber bears, which differs by "
        f"{usable[-1].number / usable[0].number:.0f} times; at equal pressure the moments differ by "
        f"{max(numbers) / min(numbers):.2f} times only"
        + (", and the softer rubber pushes harder." if numbers[0] > numbers[-1] else ".")
        + (
            ""
            if further
            else " The curvatures at equal pressure do not stand in the order of the hardness: rods "
            "in the fabric resist compression, and lock the bulged base of the softest rubber (see 5-3)."
        ),
    )


def _at_stretch(response: tg.Response, name: str, scale: float, unit: str) -> Value:
    reached = np.interp(USABLE, response["largest_stretch"], response[name], right=np.nan)
    return Value(float(reached) * scale, 0.0, unit)


def stress_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Extension and stress against pressure, stress against extension."""
    curves = tuple((name, each.response) for name, each in runs.items())
    return (
        tg.pictures.Panel(x="pressure", y="tip_displacement_x", responses=curves),
        tg.pictures.Panel(x="pressure", y="von_mises_p99", responses=curves),
        tg.pictures.Panel(x="tip_displacement_x", y="von_mises_p99", responses=curves),
    )


def force_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature and moment against pressure."""
    drawn = []
    for name, label in (("curvature_y", "curvature [1/m]"), ("blocked_moment", "moment that holds it straight [Nm]")):
        lines = [
            tg.pictures.Line(x=each.response["pressure"] / kPa, y=each.response[name], label=key)
            for key, each in runs.items()
        ]
        drawn.append(tg.pictures.Panel(x="pressure [kPa]", y=label, lines=lines))
    ends = [last(each.response, "curvature_y").number for each in runs.values()]
    drawn.append(
        tg.pictures.Panel(
            x="", y="curvature at 0.4 times the modulus [1/m]", lines=[tg.pictures.Line(x=list(runs), y=ends)]
        )
    )
    return tuple(drawn)


GUIDELINE = Guideline(
    key="7.1-1",
    rule="Silicone rubber of lower hardness bends very far at low pressure, with lower von Mises stress; its tip "
    "pushes with less force, because it bears less pressure.",
    sources=("Elsayed et al. 2014", "Galloway et al. 2013", "Qin et al. 2018"),
    families=("semicircular_bender", "fiber_reinforced_bender", "extending_cylinder", "omnidirectional_actuator"),
    studies=(
        GuidelineTest(
            title="Stroke and stress of four rubbers",
            setup="Whole tube (inner radius 6.35 mm, wall 2 mm, 60 mm long, caps of 5 mm, one end fixed), "
            "axisymmetric, in hoops of Kevlar thread every 2 mm; Ecoflex 00-30, Dragon Skin 10, Elastosil M4601, "
            "Smooth-Sil 950 (records of Polygerinos et al., neo-Hookean); extension and von Mises stress up to 0.2 "
            "times the shear modulus.",
            expected="A softer rubber extends further at 2.5 kPa, with less stress there and at 3 mm of extension.",
            runs=extension_runs,
            judge=judge_stress,
            panels=stress_panels,
        ),
        GuidelineTest(
            title="Bending and force of four rubbers",
            setup="Section of a long half-round bender (chamber radius 8 mm, wall and base 2 mm) in hoops (rods) of "
            "Kevlar thread every 2 mm, fabric of 650 N/mm along and across on the flat side; the same rubbers; "
            "curvature, and moment that holds it straight, at 2.5 kPa and where the rubber is stretched by 1.5.",
            expected="A softer rubber bends further at 2.5 kPa, and its moment at a stretch of 1.5 is smaller.",
            runs=bending_runs,
            judge=judge_force,
            panels=force_panels,
        ),
    ),
)
