"""Claim 6.2-7: more iterations let a step converge that is close to it."""

import turgor as tg
from turgor.studies import Run
from turgor_guidelines.convergence.trials import SETUP, end, reached, solve, spent
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.values import Value

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


def judge(runs: Runs) -> Judgement:
    """Few iterations stop early; more reach further."""
    shares = [reached(each) for each in runs.values()]
    further = shares == sorted(shares) and shares[-1] > shares[0]
    enough = next((name for name, share in zip(runs, shares, strict=True) if share > 1 - 1e-9), "")
    last_two = shares[-1] > shares[-2]
    return Judgement(
        verdict=verdict_of([further, last_two or not further]),
        finding=", ".join(f"{name} reach {share:.0%}" for name, share in zip(runs, shares, strict=True))
        + " of the load; angles "
        + ", ".join(f"{end(each)}" for each in runs.values()),
        conditions=(f"{enough} are enough here; more change nothing." if enough and not last_two else "")
        or ("" if further else "The number of iterations changes nothing here."),
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """What was reached, and what it took."""
    most = [float(name.split()[0]) for name in runs]
    shares = line_of(most, [Value(100 * reached(each)) for each in runs.values()])
    costs = line_of(most, [Value(spent(each, "iterations")) for each in runs.values()])
    return (
        tg.pictures.Panel(x="most iterations of a step", y="load that was reached [%]", lines=[shares]),
        tg.pictures.Panel(x="most iterations of a step", y="iterations in all", lines=[costs]),
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
