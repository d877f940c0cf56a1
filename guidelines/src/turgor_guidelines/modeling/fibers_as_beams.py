"""Claim 8.1-5: beams instead of threads add stiffness in compression; thinner ones are no cure for that."""

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.judging import change, line_of
from turgor_guidelines.modeling.benders import BENDER, bender
from turgor_guidelines.values import Value, at, listed

#: Pressures of the comparison [kPa], and the difference that counts.
PRESSURES, COUNTS = (6, 24, 60), 0.005

#: Compression of hoops and of the fabric, and the diameter of the hoops over the real one.
WAYS = {
    "all rods": ((1.0, 1.0), 1.0),
    "hoops slack": ((0.0, 1.0), 1.0),
    "hoops half as thick": ((1.0, 1.0), 0.5),
    "all slack": ((0.0, 0.0), 1.0),
}


def runs(setting: Setting) -> tuple[Run, ...]:
    """Rods, threads that go slack, and thinner rods."""
    size = 2.0 if setting == "quick" else 1.0
    common = {"rubber": "elastosil-m4601/neo-hooke-polygerinos-2020", "pressure": PRESSURES[-1], "size": size}
    return tuple(
        Run(name=name, function=bender, values=common | {"compression": list(compression), "thinner": thinner})
        for name, (compression, thinner) in WAYS.items()
    )


def _changes(runs: Runs, pressure: float) -> dict[str, float]:
    angles = {n: at(e.response, "bending_angle", "pressure", pressure * kPa) for n, e in runs.items()}
    rest = angles.pop("all rods")
    return {name: change(angle, rest) for name, angle in angles.items()}


def judge(runs: Runs) -> Judgement:
    """Rods bend less than threads by more than what counts; where hoops are in tension they do not."""
    changes = {pressure: _changes(runs, pressure) for pressure in PRESSURES}
    hoops = [abs(row["hoops slack"]) > COUNTS for row in changes.values()]
    fabric = [row["all slack"] > COUNTS for row in changes.values()]
    verdict = Verdict.CONFIRMED if all(hoops) and all(fabric) else Verdict.CONDITIONAL
    if not any(hoops + fabric):
        verdict = Verdict.NOT_REPRODUCED
    summary = "; ".join(
        f"{pressure} kPa " + ", ".join(f"{name} {size:+.1%}" for name, size in row.items())
        for pressure, row in changes.items()
    )
    where = [f"{p} kPa" for p, more in zip(PRESSURES, hoops, strict=True) if more]
    angles = [at(runs["all rods"].response, "bending_angle", "pressure", p * kPa) for p in PRESSURES]
    return Judgement(
        verdict=verdict,
        finding=f"angle against that with rods everywhere: {summary}; with rods {listed(angles)}",
        conditions=f"For the hoops it matters {'at ' + ', '.join(where) if where else 'nowhere here'}, because they "
        f"are in "
        "tension elsewhere; the fabric along the base resists bending as rods and hardly as threads.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves, and changes."""
    curves = tuple((name, each.response) for name, each in runs.items())
    lines = []
    for pressure in PRESSURES:
        changes = _changes(runs, pressure)
        lines.append(line_of(list(changes), [Value(100 * size) for size in changes.values()], f"{pressure} kPa"))
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=curves),
        tg.pictures.Panel(x="fibers", y="angle against rods [%]", lines=lines),
    )


GUIDELINE = Guideline(
    key="8.1-5",
    rule="Beam elements as fibers add stiffness that threads do not have, in bending and in compression.",
    sources=("Polygerinos et al. 2015", "Decroly et al. 2019"),
    families=("fiber_reinforced_bender",),
    studies=(
        GuidelineTest(
            title="Rods or threads",
            setup=BENDER
            + "; neo-Hookean (0.12 MPa); fibers that resist compression or go slack, and hoops of half the "
            "diameter. Smeared fibers do not bend: this study is about compression only.",
            expected=f"Threads bend further than rods, by more than {COUNTS:.1%}.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
