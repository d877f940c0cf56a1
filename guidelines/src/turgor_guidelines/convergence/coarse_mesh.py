"""Claim 6.2-1: a coarse mesh moves less than a fine one, and misses strong ballooning."""

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.convergence.mesh_size import bend
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.values import Value, at

#: Width of the bender [mm], sizes of its cells [mm], the last one as reference, and the pressure [kPa].
WIDTH, SIZES, PRESSURE = 25, (6.0, 3.0, 2.0, 1.0, 0.5), 40

#: Kinds of benders, and quantities with what is subtracted from them.
KINDS = {"without hoops": False, "with hoops": True}
QUANTITIES = {"curvature_y": 0.0, "cavity_ballooning": 1.0}

#: Difference from the finest mesh that is read as none.
SAME = 0.001


def runs(setting: Setting) -> tuple[Run, ...]:
    """Every size, with hoops and without; sections are cheap, so both settings have all."""
    del setting
    return tuple(
        Run(
            name=f"{kind}, cells of {size:g} mm",
            function=bend,
            values={"width": WIDTH, "size": size} | ({} if hoops else {"hoops": False}),
        )
        for kind, hoops in KINDS.items()
        for size in SIZES
    )


def _values(runs: Runs, kind: str, column: str) -> list[float]:
    """A quantity at the pressure for all sizes."""
    responses = [runs[f"{kind}, cells of {size:g} mm"].response for size in SIZES]
    return [at(each, column, "pressure", PRESSURE * kPa).number - QUANTITIES[column] for each in responses]


def _short(values: list[float]) -> list[float]:
    """Difference of each to the finest, relative."""
    return [value / values[-1] - 1 for value in values[:-1]]


def judge(runs: Runs) -> Judgement:
    """The coarsest mesh moves less than the finest, for both quantities of both kinds."""
    holds, parts, notes = [], [], []
    for kind in KINDS:
        for column in QUANTITIES:
            short = _short(_values(runs, kind, column))
            name = column.split("_")[-2 if column.startswith("curvature") else -1]
            holds.append(short[0] < -SAME)
            sizes = ", ".join(f"{size:g} mm {value:+.2%}" for size, value in zip(SIZES, short, strict=False))
            parts.append(f"{name} {kind} {sizes}")
            notes += [] if holds[-1] else [f"The {name} {kind} is not less on the coarsest mesh."]
            rising = all(b >= a - SAME for a, b in zip(short, [*short[1:], 0.0], strict=True))
            notes += [] if rising else [f"The {name} {kind} does not rise from mesh to mesh."]
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"against cells of {SIZES[-1]:g} mm: {'; '.join(parts)}",
        conditions=" ".join(notes),
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves without hoops, and differences against the size."""
    curves = tuple((n.split(", ")[1], e.response) for n, e in runs.items() if n.startswith("without"))
    out = [tg.pictures.Panel(x="pressure", y="cavity_ballooning", responses=curves)]
    for column in QUANTITIES:
        lines = [
            line_of(list(SIZES[:-1]), [Value(100 * v) for v in _short(_values(runs, kind, column))], kind)
            for kind in KINDS
        ]
        out.append(tg.pictures.Panel(x="size of cells [mm]", y=f"{column}, off the finest [%]", lines=lines))
    return tuple(out)


STUDY = GuidelineTest(
    title="Size of the cells",
    setup="Section of a semicircular bender 25 mm wide, wall 2.5 mm, of Elastosil M4601 (Yeoh), a fabric of 650 "
    "N/mm on the "
    f"flat side, with Kevlar hoops every 3 mm and without, {PRESSURE} kPa; quadratic elements with mean stresses.",
    expected="Curvature and ballooning are less on the coarsest mesh.",
    runs=runs,
    judge=judge,
    panels=panels,
)

GUIDELINE = Guideline(
    key="6.2-1",
    rule="A coarse mesh results in less motion at the same pressure, and misses strong ballooning.",
    sources=("Tawk and Alici 2020", "Xavier et al. 2021"),
    families=("fiber_reinforced_bender",),
    studies=(STUDY,),
)
