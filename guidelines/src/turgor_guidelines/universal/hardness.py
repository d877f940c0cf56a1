"""Guideline 7.0-2: softer rubber deforms more at lower pressure."""

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.parts import threads
from turgor_guidelines.sections import solved_twice
from turgor_guidelines.values import Value

#: Records of rubbers from soft to hard, by the hardness of their makers, with its rank.
RECORDS = (
    (1, "ecoflex-00-10", "generalized-rivlin-kulkarni-2015"),
    (2, "ecoflex-00-30", "yeoh-polygerinos-2015"),
    (2, "ecoflex-00-30", "ogden-moseley-2016"),
    (3, "ecoflex-00-50", "ogden-elsayed-2014"),
    (3, "ecoflex-00-50", "yeoh-kulkarni-2015"),
    (4, "dragon-skin-10", "neo-hooke-polygerinos-2020"),
    (4, "dragon-skin-10", "yeoh-caasenbrood-2020"),
    (5, "dragon-skin-20", "ogden-nuthi-2018"),
    (6, "elastosil-m4601", "neo-hooke-polygerinos-2020"),
    (6, "elastosil-m4601", "yeoh-mosadegh-2014"),
    (7, "dragon-skin-30", "mooney-rivlin-elsayed-2014"),
    (7, "dragon-skin-30", "yeoh-yang-2020"),
    (8, "smooth-sil-950", "neo-hooke-polygerinos-2020"),
    (8, "smooth-sil-950", "neo-hooke-connolly-2017"),
)

#: Records of one study, the same law from one table; the requested stretch; last pressure over the modulus.
ONE_TABLE, STRETCH, LARGEST = "neo-hooke-polygerinos-2020", 1.1, 0.3


def extend(rubber: str, record: str, size: float) -> Computed:
    """Extend a tube in hoops of a rubber of the library, up to a pressure of 0.3 times its shear modulus."""
    material = tg.from_library(rubber, record=record)
    highest = LARGEST * material.law.shear_modulus

    def solve(cell: float) -> tg.sections.SectionSolution:
        section = tg.Section(
            tg.actuators.FiberReinforcedCylinder(), {"body": material}, reinforcements=[threads()], size=cell
        )
        return section.solve(np.linspace(0, highest, 13), throw=False, mesh_error=False)

    return solved_twice(solve, size * mm)


def runs(setting: Setting) -> tuple[Run, ...]:
    """A tube of each record."""
    size = 2.0 if setting == "quick" else 1.0
    return tuple(
        Run(
            name=f"{rubber}, {record}",
            function=extend,
            values={"rubber": rubber, "record": record, "size": size},
        )
        for _, rubber, record in RECORDS
    )


def ranks() -> dict[str, int]:
    """Rank of the hardness by the name of the run."""
    return {f"{rubber}, {record}": rank for rank, rubber, record in RECORDS}


def needed(runs: Runs) -> dict[str, Value]:
    """Pressure for the requested stretch [kPa]."""
    return {
        name: Value(
            float(np.interp(STRETCH, each.response["stretch"], each.response["pressure"] / kPa, right=np.nan)),
            0.0,
            "kPa",
        )
        for name, each in runs.items()
    }


def judge(runs: Runs) -> Judgement:
    """Pairs of records of which the harder rubber needs less pressure."""
    pressures, rank = needed(runs), ranks()
    names = list(runs)
    pairs = [(a, b) for a in names for b in names if rank[a] < rank[b]]
    wrong = [(a, b) for a, b in pairs if not pressures[a].number < pressures[b].number]
    table = sorted((name for name in names if name.endswith(ONE_TABLE) or "polygerinos" in name), key=rank.__getitem__)
    same_table = [pressures[name].number for name in table]
    holds = same_table == sorted(same_table)
    worst = max(wrong, key=lambda pair: pressures[pair[0]].number / pressures[pair[1]].number) if wrong else None
    verdict = Verdict.CONFIRMED if not wrong else Verdict.CONDITIONAL if holds else Verdict.NOT_REPRODUCED
    return Judgement(
        verdict=verdict,
        finding=f"Pressure for a stretch of {STRETCH:g}: "
        + "; ".join(f"{name} {pressures[name]}" for name in names)
        + f". {len(pairs) - len(wrong)} of {len(pairs)} pairs of records stand in the order of their hardness.",
        conditions=f"Rubbers whose constants come from one group ({len(table)} records of Polygerinos et al.) "
        + ("stand in order. " if holds else "do not stand in order. ")
        + (
            f"Records of different groups need not: {worst[0]} needs "
            f"{pressures[worst[0]].number / pressures[worst[1]].number:.1f} times the pressure of the harder "
            f"{worst[1]}. The modulus of the record decides, and one hardness stands for moduli that differ by more "
            "than neighboring hardnesses do."
            if worst
            else "All records agree."
        ),
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Stretch against pressure, against pressure over modulus, and pressure against the hardness."""
    pressures, rank = needed(runs), ranks()
    shown = {name: each for name, each in runs.items() if "polygerinos" in name}
    curves = [
        tg.pictures.Line(x=each.response["pressure"] / kPa, y=each.response["stretch"], label=name)
        for name, each in shown.items()
    ]
    points = [
        tg.pictures.Line(x=[rank[name] for name in chosen], y=[pressures[name].number for name in chosen], label=label)
        for label, chosen in (
            ("one group", list(shown)),
            ("others", sorted((name for name in runs if name not in shown), key=rank.__getitem__)),
        )
    ]
    return (
        tg.pictures.Panel(x="pressure [kPa]", y="stretch [-]", lines=curves),
        tg.pictures.Panel(
            x="rank of the hardness, 00-10 to 50 A", y=f"pressure for a stretch of {STRETCH:g} [kPa]", lines=points
        ),
    )


RECORDS_STUDY = GuidelineTest(
    title="Rubbers of the library by their hardness",
    setup="Section of a long tube (inner radius 6.35 mm, outer 8.35 mm, closed ends) in hoops of Kevlar thread every 2 "
    "mm, of 14 records of eight rubbers from 00-10 to 50 A Shore; pressure for a stretch of 1.1.",
    expected="A harder rubber needs more pressure, for every pair of records.",
    runs=runs,
    judge=judge,
    panels=panels,
)

GUIDELINE = Guideline(
    key="7.0-2",
    rule="Silicone rubber of lower hardness deforms more at lower pressure.",
    sources=("Elsayed et al. 2014", "Galloway et al. 2013", "Qin et al. 2018"),
    families=("fiber_reinforced_cylinder", "semicircular_bender"),
    studies=(RECORDS_STUDY,),
)
