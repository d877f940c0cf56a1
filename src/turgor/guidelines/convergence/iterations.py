"""Claim 6.2-7: more iterations let a step converge that is close to it."""

from turgor.guidelines.convergence.trials import SETUP, end, reached, solve, spent
from turgor.guidelines.guideline import Found, Guideline, GuidelineTest, Judgement, Setting
from turgor.guidelines.judging import line_of, verdict_of
from turgor.guidelines.values import Value
from turgor.studies.runs.run import Run
from turgor.views.plots.study_figure import Panel

#: Pressure [kPa], size of the steps as a share of it, and the most iterations of a step.
PRESSURE, STEP, MOST = 25, 0.2, (3, 5, 15, 50)


def runs(setting: Setting) -> tuple[Run, ...]:
    """Steps of fixed size with more and more iterations."""
    size = 6.0 if setting == "quick" else 3.0
    steps = {"first_step": STEP, "max_step": STEP, "min_step": STEP}
    return tuple(
        Run(
            name=f"{most} iterations",
            function=solve,
            values={"size": size, "pressure": PRESSURE, "steps": steps | {"max_iterations": most}},
        )
        for most in MOST
    )


def judge(found: Found) -> Judgement:
    """Few iterations stop early; more reach further."""
    shares = [reached(each) for each in found.values()]
    further = shares == sorted(shares) and shares[-1] > shares[0]
    enough = next((name for name, share in zip(found, shares, strict=True) if share > 1 - 1e-9), "")
    last_two = shares[-1] > shares[-2]
    return Judgement(
        verdict=verdict_of([further, last_two or not further]),
        found=", ".join(f"{name} reach {share:.0%}" for name, share in zip(found, shares, strict=True))
        + " of the load; angles "
        + ", ".join(f"{end(each)}" for each in found.values()),
        conditions=(f"{enough} are enough here; more change nothing." if enough and not last_two else "")
        or ("" if further else "The number of iterations changes nothing here."),
    )


def panels(found: Found) -> tuple[Panel, ...]:
    """What was reached, and what it took."""
    most = [float(name.split()[0]) for name in found]
    shares = line_of(most, [Value(100 * reached(each)) for each in found.values()])
    costs = line_of(most, [Value(spent(each, "iterations")) for each in found.values()])
    return (
        Panel(x="most iterations of a step", y="load that was reached [%]", lines=[shares]),
        Panel(x="most iterations of a step", y="iterations in all", lines=[costs]),
    )


GUIDELINE = Guideline(
    key="6.2-7",
    rule="More iterations help simulations that are close to converging.",
    sources=("Xavier et al. 2021",),
    families=("semicircular_bender",),
    studies=(
        GuidelineTest(
            title="Most iterations of a step",
            setup=SETUP + f", {PRESSURE} kPa; hexahedra; five steps of fixed size.",
            expected="With few iterations the run stops early; 50 reach further than 15.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
