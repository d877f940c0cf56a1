"""Guideline 7.1-4: one actuator bends to opposite sides below and above a threshold."""

import numpy as np

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.single_chamber.half_round import BARE, BENDER, HOOPED, bend, cells
from turgor_guidelines.values import Value

#: Base of the benders [mm], and the last pressure [kPa].
BASES, PRESSURE = (1.0, 1.5, 2.0, 4.0), 20.0


def runs(setting: Setting) -> tuple[Run, ...]:
    """Benders with bases of several thicknesses, bare and in hoops."""
    return tuple(
        Run(
            name=f"{around}, base {base:g} mm",
            function=bend,
            values={
                "radius": 8.0,
                "wall": 2.0,
                "base": base,
                "hooped": around == HOOPED,
                "pressure": PRESSURE,
                "size": cells(setting),
            },
        )
        for around in (BARE, HOOPED)
        for base in (BASES if around == BARE else BASES[::3])
    )


def furthest_back(response: tg.Response) -> Value:
    """Largest curvature to the other side [1/m], with its mesh error; not positive where there is none."""
    k = int(np.argmin(response["curvature_y"]))
    errors = response.mesh_error("curvature_y")
    return Value(-float(response["curvature_y"][k]), float(errors[k]) if errors is not None else 0.0, "1/m")


def threshold(response: tg.Response) -> float:
    """Pressure at which it is straight again [kPa]; not a number where it does not turn."""
    pressure, bends = response["pressure"] / kPa, response["curvature_y"]
    turns = [k for k in range(1, len(bends)) if bends[k - 1] < 0 < bends[k]]
    if not turns:
        return np.nan
    k = turns[0]
    return float(pressure[k - 1] - bends[k - 1] * (pressure[k] - pressure[k - 1]) / (bends[k] - bends[k - 1]))


def judge(runs: Runs) -> Judgement:
    """Which of them bend back first by more than the mesh error, and where they turn."""
    back = {name: furthest_back(each.response) for name, each in runs.items()}
    turn = {name: threshold(each.response) for name, each in runs.items()}
    both = [name for name in runs if back[name].number > back[name].error and np.isfinite(turn[name])]
    never = [name for name in runs if name not in both]
    bare = {name for name in runs if name.startswith(BARE)}
    largest = max((abs(each.response["curvature_y"]).max() for each in runs.values()), default=0.0)
    return Judgement(
        verdict=Verdict.NOT_REPRODUCED if not both else Verdict.CONDITIONAL if never else Verdict.CONFIRMED,
        finding="; ".join(
            f"{name}: {back[name]} to the round side, straight again at {turn[name]:.1f} kPa" for name in both
        )
        + (f". Only to the flat side: {', '.join(never)}." if never else "."),
        conditions=f"Two directions were seen {'only bare' if set(both) <= bare else 'bare and in hoops'}: without "
        "hoops bending begins with the square of the pressure, and the term of first order that the fabric adds is "
        "small and of the other sign. A thicker base lowers the threshold. The way back is short: "
        f"{max((each.number for each in back.values()), default=0.0):.2g} 1/m against {largest:.2g} 1/m at the end. "
        "The threshold of the rule was seen on balloons of two layers; this is another actuator.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature of the bare benders against pressure, and the threshold against the base."""
    bare = {name: each.response for name, each in runs.items() if name.startswith(BARE)}
    lines = [
        tg.pictures.Line(x=each["pressure"] / kPa, y=each["curvature_y"], label=name) for name, each in bare.items()
    ]
    turned = [(float(name.split()[-2]), threshold(each)) for name, each in bare.items() if np.isfinite(threshold(each))]
    drawn = [tg.pictures.Panel(x="pressure [kPa]", y="curvature, bare [1/m]", lines=lines)]
    if turned:
        where = tg.pictures.Line(x=[base for base, _ in turned], y=[each for _, each in turned])
        drawn.append(tg.pictures.Panel(x="base [mm]", y="pressure of the threshold [kPa]", lines=[where]))
    return tuple(drawn)


GUIDELINE = Guideline(
    key="7.1-4",
    rule="Actuation in two directions can be had from one actuator that bends to opposite sides below and above a "
    "threshold.",
    sources=("Gorissen et al. 2011",),
    families=("semicircular_bender", "fiber_reinforced_bender"),
    studies=(
        GuidelineTest(
            title="Sign of the curvature against pressure, for several bases",
            setup=f"{BENDER}; chamber radius 8 mm, wall 2 mm, base 1 to 4 mm; curvature up to 20 kPa.",
            expected="The curvature changes its sign at a pressure.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
