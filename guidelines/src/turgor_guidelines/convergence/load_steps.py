"""Claim 6.2-6: smaller load steps converge where the whole load in one step does not."""

import turgor as tg
from turgor.studies import Run
from turgor_guidelines.convergence.trials import SETUP, end, reached, solve, spent
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.values import Value, listed

#: Pressure [kPa], and sizes of the steps as shares of it, the largest one first.
PRESSURE, STEPS = 25, (1.0, 0.5, 0.2, 0.1)

#: Difference of the ends that is allowed: what the tolerance of the iteration leaves.
SAME = 1e-4


def runs(setting: Setting) -> tuple[Run, ...]:
    """Steps of fixed size: a step that does not converge ends the run."""
    size = 6.0 if setting == "quick" else 3.0
    return tuple(
        Run(
            name=f"{1 / step:.0f} steps",
            function=solve,
            values={
                "size": size,
                "pressure": PRESSURE,
                "steps": {"first_step": step, "max_step": step, "min_step": step},
            },
        )
        for step in STEPS
    )


def judge(runs: Runs) -> Judgement:
    """One step fails, small ones reach the end, and all that do reach the same end."""
    complete = {name: reached(each) > 1 - 1e-9 for name, each in runs.items()}
    names = list(runs)
    ends = [end(runs[name]) for name in names if complete[name]]
    same = all(abs(each.number / ends[-1].number - 1) < SAME for each in ends) if ends else False
    summary = ", ".join(f"{name} {reached(runs[name]):.0%} of the load" for name in names)
    iterations = ", ".join(f"{spent(runs[name], 'iterations'):.0f}" for name in names)
    return Judgement(
        verdict=verdict_of([not complete[names[0]], complete[names[-1]] and same]),
        finding=f"reached: {summary}; iterations {iterations}"
        + (f"; angles at the end {listed(ends)}" if ends else ""),
        conditions="The whole load in one step converges here: the step matters less to this iteration than to plain "
        "Newton's."
        if complete[names[0]]
        else "",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves, and what was reached."""
    curves = tuple((name, each.response) for name, each in runs.items())
    shares = line_of(list(runs), [Value(100 * reached(each)) for each in runs.values()])
    costs = line_of(list(runs), [Value(spent(each, "iterations")) for each in runs.values()])
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=curves),
        tg.pictures.Panel(x="steps", y="load that was reached [%]", lines=[shares]),
        tg.pictures.Panel(x="steps", y="iterations", lines=[costs]),
    )


GUIDELINE = Guideline(
    key="6.2-6",
    rule="Smaller time steps, or more substeps, improve convergence: the load is not applied in one step.",
    sources=("Tawk and Alici 2020",),
    families=("semicircular_bender",),
    studies=(
        GuidelineTest(
            title="Number of steps",
            setup=SETUP
            + f", {PRESSURE} kPa; hexahedra; steps of fixed size, a step that does not converge ends the run.",
            expected="One step fails, ten reach the whole load; all that reach it end in the same state.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
