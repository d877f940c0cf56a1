"""Claim 6.2-3: symmetry gives the same answer with fewer elements."""

import turgor as tg
from turgor.studies import Run
from turgor_guidelines.convergence.trials import SETUP, end, solve, spent
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import change, line_of, verdict_of
from turgor_guidelines.values import Value, listed

#: Pressure [kPa], and the difference that is allowed.
PRESSURE, SAME = 10, 0.005


def runs(setting: Setting) -> tuple[Run, ...]:
    """Half a model, and the whole."""
    size = 6.0 if setting == "quick" else 3.0
    return tuple(
        Run(name=name, function=solve, values={"size": size, "pressure": PRESSURE, "symmetric": half})
        for name, half in (("half", True), ("whole", False))
    )


def judge(runs: Runs) -> Judgement:
    """The same angle and the same ballooning, with about half the degrees of freedom."""
    half, whole = runs["half"], runs["whole"]
    apart = [change(end(half, name), end(whole, name)) for name in ("bending_angle", "ballooning")]
    share = spent(half, "unknowns") / spent(whole, "unknowns")
    time = half.seconds / whole.seconds if whole.seconds else float("nan")
    return Judgement(
        verdict=verdict_of([*(abs(each) < SAME for each in apart), share < 0.7]),
        finding=f"half and whole: {listed([end(half), end(whole)])}, {apart[0]:+.2%} in the angle and {apart[1]:+.2%} "
        f"in the "
        f"largest displacement; {share:.0%} of the unknowns, {time:.0%} of the CPU time",
        conditions="It holds where load and motion are symmetric too: not for twist, nor for one of three chambers "
        "off the "
        "plane.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Both curves, and the unknowns."""
    curves = tuple((name, each.response) for name, each in runs.items())
    costs = line_of(list(runs), [Value(spent(each, "unknowns")) for each in runs.values()])
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=curves),
        tg.pictures.Panel(x="model", y="unknowns", lines=[costs]),
    )


GUIDELINE = Guideline(
    key="6.2-3",
    rule="Symmetry reduces the number of elements: half a bender and a quarter of an extender serve.",
    sources=("Gent 2012", "Moseley et al. 2016"),
    families=("semicircular_bender",),
    studies=(
        GuidelineTest(
            title="Half and whole",
            setup=SETUP + f", {PRESSURE} kPa; hexahedra; cut at its mirror plane, or whole.",
            expected=f"Angles within {SAME:.1%}, half the degrees of freedom.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
