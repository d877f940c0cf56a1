"""Claim 6.2-2: cells of 1 to 3 mm are a good start for actuators of usual size."""

from functools import partial
from typing import Any

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.modeling.benders import rubber_of, threads
from turgor_guidelines.values import Value, last

#: Widths of the benders [mm], sizes of cells [mm] and the reference size, and the pressures [kPa].
WIDTHS, SIZES, FINEST = (10, 25), (6.0, 3.0, 2.0, 1.0), 0.5
PRESSURE, PAPER_PRESSURE, STEP = 40, 20, 10

#: Difference to the finest mesh that is good enough to start with.
GOOD = 0.03


def bend(width: float, size: float, hoops: bool = True, paper: bool = False) -> Computed:
    """Bend the section of a bender of a width [mm], cells of a size [mm]; on paper or a fabric, perhaps in hoops."""
    scale = width / 20 * mm
    finger = tg.actuators.FiberReinforcedBender(
        radius=8 * scale, wall=2 * scale, base=2 * scale, skin=0.0, length=100 * mm
    )
    flat = "strain_limiting_layer"
    materials: dict[str, Any] = {"body": rubber_of("elastosil-m4601/yeoh-mosadegh-2014")}
    fibers, highest = [], PAPER_PRESSURE if paper else PRESSURE
    if paper:
        sheet = tg.from_library("paper", record="hooke-polygerinos-2020")
        materials |= {flat: tg.Shell(sheet, thickness=0.1 * mm)}
    else:
        fibers = [threads(flat, angle, 1.187, 1.0) for angle in (0, 90)]
    fibers += [threads(("outside", flat), 90, 3, 1.0)] if hoops else []
    section = tg.Section(finger, materials, reinforcements=fibers, size=size * mm)
    result = section.solve([p * kPa for p in range(0, highest + 1, STEP)], throw=False, mesh_error=False).response
    cells = tg.experiments.Column("cells", "", result["stretch"] * 0 + len(section.model.mesh.cells))
    columns = [result.find(name) for name in ("pressure", "curvature_y", "cavity_ballooning")]
    return Computed(
        response=tg.Response(
            columns=(*columns, cells), source=result.source, status=result.status, message=result.message
        )
    )


def runs(setting: Setting, paper: bool = False) -> tuple[Run, ...]:
    """Narrow and wide ones, every size; sections are cheap, so both settings have all."""
    del setting
    return tuple(
        Run(
            name=f"{width} mm wide, cells of {size:g} mm",
            function=bend,
            values={"width": width, "size": size} | ({"hoops": False, "paper": True} if paper else {}),
        )
        for width in WIDTHS
        for size in (*SIZES, FINEST)
    )


def _apart(runs: Runs, column: str, width: float) -> dict[float, float]:
    """Difference to the finest cells by size, relative."""
    values = {}
    for size in (*SIZES, FINEST):
        response = runs[f"{width} mm wide, cells of {size:g} mm"].response
        values[size] = last(response, column).number - (column == "cavity_ballooning")
    return {size: values[size] / values[FINEST] - 1 for size in SIZES}


def judge(runs: Runs) -> Judgement:
    """Cells of 1 to 3 mm are good enough for both widths, for bending and for ballooning."""
    holds, rows, notes = [], [], []
    for width in WIDTHS:
        for column, name in (("curvature_y", "curvature"), ("cavity_ballooning", "ballooning")):
            apart = _apart(runs, column, width)
            holds += [abs(apart[size]) < GOOD for size in SIZES if size <= 3]
            rows.append(
                f"{width} mm wide, {name} " + ", ".join(f"{size:g} mm {value:+.2%}" for size, value in apart.items())
            )
            coarse = [f"{size:g} mm" for size in SIZES if size > 3 and abs(apart[size]) < GOOD]
            poor = [f"{size:g} mm" for size in SIZES if size <= 3 and abs(apart[size]) >= GOOD]
            about = f"the {name} of the one {width} mm wide"
            notes += [f"For {about} {' and '.join(coarse)} are enough too."] if coarse else []
            notes += [f"For {about} {' and '.join(poor)} are too coarse."] if poor else []
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"against cells of {FINEST:g} mm: {'; '.join(rows)}",
        conditions=" ".join(notes),
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Differences against the size."""
    out = []
    for column, name in (("curvature_y", "curvature"), ("cavity_ballooning", "ballooning")):
        lines = []
        for width in WIDTHS:
            apart = _apart(runs, column, width)
            lines.append(line_of(list(apart), [Value(100 * abs(v)) for v in apart.values()], f"{width} mm wide"))
        out.append(tg.pictures.Panel(x="size of cells [mm]", y=f"{name}, off the finest [%]", lines=lines))
    return tuple(out)


BENDERS = (
    "Sections of semicircular benders, 10 and 25 mm wide, wall a tenth of the width, of Elastosil M4601 (Yeoh, 0.11 "
    "and 0.02 MPa)"
)
EXPECTED = (
    f"Curvature and ballooning within {GOOD:.0%} of those with elements of {FINEST:g} mm, for elements of 1 to 3 mm."
)

GUIDELINE = Guideline(
    key="6.2-2",
    rule="For actuators of 10 to 25 mm width, elements of 1 to 3 mm are a good starting point.",
    sources=("Xavier et al. 2021",),
    families=("fiber_reinforced_bender",),
    studies=(
        GuidelineTest(
            title="Benders of 10 and 25 mm width",
            setup=f"{BENDERS}, Kevlar hoops every 3 mm, a fabric of 650 N/mm on the flat side, {PRESSURE} kPa; "
            "quadratic elements of several sizes.",
            expected=EXPECTED,
            runs=runs,
            judge=judge,
            panels=panels,
        ),
        GuidelineTest(
            title="The same without hoops, on paper",
            setup=f"{BENDERS}, paper of 0.1 mm on the flat side, no hoops, {PAPER_PRESSURE} kPa, where they balloon.",
            expected=EXPECTED,
            runs=partial(runs, paper=True),
            judge=judge,
            panels=panels,
        ),
    ),
)
