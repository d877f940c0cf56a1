"""Claim 5-3: softer rubber needs less pressure for the same stroke."""

import turgor as tg
from turgor.studies import Run
from turgor.units import deg
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.modeling.benders import BENDER, bender
from turgor_guidelines.multi_chamber.pneunets import at_angle
from turgor_guidelines.values import Value, listed, rises

#: Rubbers from soft to hard, with the pressure up to which the bender is followed [kPa].
RUBBERS = {
    "Ecoflex 00-30": ("ecoflex-00-30/yeoh-kulkarni-2015", 7),
    "Ecoflex 00-50": ("ecoflex-00-50/yeoh-kulkarni-2015", 10),
    "Dragon Skin 10": ("dragon-skin-10/yeoh-caasenbrood-2020", 20),
    "Dragon Skin 30": ("dragon-skin-30/yeoh-chen-2018", 50),
    "Elastosil M4601": ("elastosil-m4601/yeoh-mosadegh-2014", 60),
    "Smooth-Sil 950": ("smooth-sil-950/generalized-rivlin-ellis-2019", 150),
}

#: Angle at which pressures are compared [deg].
ANGLE = 20


#: Fabric of the flat side: the share of its stiffness in compression and of the pressures. Rods keep the base from
#: bending once it bulges; threads go slack, all but a little that keeps the solve short, and bend further.
FABRICS = {"fabric of threads": (0.02, 0.4), "fabric of rods": (1.0, 1.0)}


def runs(setting: Setting) -> tuple[Run, ...]:
    """The same bender of each rubber, with both kinds of fabric."""
    size = 2.0 if setting == "quick" else 1.0
    return tuple(
        Run(
            name=f"{name}, {fabric}",
            function=bender,
            values={"rubber": rubber, "pressure": less * pressure, "size": size, "compression": [share, share]},
        )
        for fabric, (share, less) in FABRICS.items()
        for name, (rubber, pressure) in RUBBERS.items()
    )


def _pressures(runs: Runs, fabric: str) -> tuple[float, list[Value]]:
    """Common angle [deg] of the benders with a fabric, and their pressures there."""
    kind = [each.response for name, each in runs.items() if name.endswith(fabric)]
    angle = min(ANGLE, *(0.999 * float((each.column("bending_angle") / deg).max()) for each in kind))
    return angle, [at_angle(each, "pressure", angle) for each in kind]


def judge(runs: Runs) -> Judgement:
    """Pressures for an angle rise with the hardness."""
    parts, holds, notes = [], [], []
    for fabric in FABRICS:
        angle, pressures = _pressures(runs, fabric)
        holds.append(rises(pressures))
        times = pressures[-1].number / pressures[0].number
        parts.append(f"{fabric}: {listed(pressures)} for {angle:.3g} deg")
        notes.append(f"With a {fabric} the hardest needs {times:.2g} times the pressure of the softest.")
        if not holds[-1]:
            notes.append("The order is not that of the hardness there.")
    return Judgement(
        verdict=verdict_of(holds), finding=f"{', '.join(RUBBERS)}: {'; '.join(parts)}", conditions=" ".join(notes)
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves of both kinds, and the pressures."""
    out = [
        tg.pictures.Panel(
            x="pressure",
            y="bending_angle",
            responses=tuple((n.split(",")[0], e.response) for n, e in runs.items() if n.endswith(fabric)),
        )
        for fabric in FABRICS
    ]
    lines = []
    for fabric in FABRICS:
        angle, pressures = _pressures(runs, fabric)
        lines.append(line_of(list(RUBBERS), pressures, f"{fabric}, {angle:.3g} deg"))
    return (*out, tg.pictures.Panel(x="rubber", y="pressure for an angle [kPa]", lines=lines))


GUIDELINE = Guideline(
    key="5-3",
    rule="Softer rubbers such as Ecoflex need lower pressures for the same bending or extension.",
    sources=("Elsayed et al. 2014", "Marechal et al. 2020"),
    families=("fiber_reinforced_bender",),
    studies=(
        GuidelineTest(
            title="One bender, six rubbers",
            setup=BENDER
            + "; rubbers by their published Yeoh constants (Smooth-Sil 950: generalized Rivlin). The fabric once as "
            "rods, once as threads that go slack but for 2 % of their stiffness.",
            expected="The pressure for 20 deg rises from Ecoflex 00-30 to Smooth-Sil 950, in the order of hardness.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
