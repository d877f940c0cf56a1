"""Count the runs of searches: those of turgor, and COBYQA and least squares of SciPy.

Run ``python benchmarks/searches.py``, about a minute: formulas whose answers are known, and a tube of finite elements.

A run counts until the answer is there: all targets within their tolerances; else limits kept within theirs, and an
objective that is at most 0.1 % above the lowest one. A dash says that it was not there after 60 runs.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from scipy.optimize import Bounds, NonlinearConstraint, least_squares, minimize

sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))

import calibration_cases
import optimization_cases as cases
import turgor as tg
from turgor.studies.calibration import calibrate
from turgor.studies.calibration.objective import Objective
from turgor.studies.calibration.search import SearchResult, no_step_left
from turgor.studies.optimization.goals import MET, Limit, Minimize
from turgor.studies.optimization.optimize import _problem, _scaled, _start
from turgor.studies.optimization.problem import Problem
from turgor.studies.optimization.searches.trust_region import trust_region
from turgor.studies.runs.jobs.job_function import job_function
from turgor.units import kPa, mm

#: Runs at most, and how near an objective has to come.
MOST, NEAR = 60, 1e-3

studies = tg.studies


class DoneError(Exception):
    """The answer is there, or no run is left."""


@dataclass(frozen=True)
class Case:
    """A search with a known answer."""

    name: str
    function: Callable[..., tg.Response]
    factors: list[studies.Factor]
    goals: list
    start: dict[str, float]
    lowest: float | None = None
    evaluations: studies.Evaluations | None = None

    def problem(self) -> tuple[Problem, np.ndarray]:
        """The problem with its scales, without candidates, and where the search begins."""
        settings = studies.Search(most_solves=MOST, slopes=False)
        runs = self.evaluations or studies.Evaluations()
        computation = self.function
        if not isinstance(computation, studies.Computation):
            computation = studies.Computation(function=self.function)
        made = _problem(computation, self.factors, self.goals, settings, runs)
        begin = _start(made, self.start)
        return _problem(computation, self.factors, _scaled(made, begin), settings, runs), begin

    def runs_needed(self, problem: Problem) -> int | None:
        """Number of runs until the answer was there."""
        for number, each in enumerate(problem.candidates, start=1):
            if not each.score.feasible:
                continue
            if self.lowest is None:
                if all(length <= 1 for length in lengths(problem, each.readings)):
                    return number
            elif abs(each.readings[0] - self.lowest) <= NEAR * abs(self.lowest):
                return number
        return None


def lengths(problem: Problem, readings: np.ndarray) -> list[float]:
    """Misfit of each target in tolerances."""
    return [float(np.linalg.norm(each)) for each in scaled(problem, readings, MET)]


def scaled(problem: Problem, readings: np.ndarray, kinds: tuple[type, ...]) -> list[np.ndarray]:
    """What goals of some kinds read, scaled: targets are met below 1, limits below 1."""
    pairs = zip(problem.goals, problem.parts(readings), strict=True)
    return [(part - goal.linear()[1]) / goal.linear()[0] for goal, part in pairs if isinstance(goal, kinds)]


def readings_of(case: Case, problem: Problem, at: np.ndarray) -> np.ndarray:
    """Compute a candidate, unless the answer is there."""
    if case.runs_needed(problem) or problem.remaining <= 0:
        raise DoneError
    return problem.compute([at])[0].readings


def search_cobyqa(case: Case, problem: Problem, begin: np.ndarray, as_limits: bool) -> None:
    """Targets as a sum of squares, or as limits on both sides; limits as constraints.

    Values are divided by 100, so that a tolerance of 1 % is 0.01: COBYQA takes what is near 1.
    """

    def objective(at: np.ndarray) -> float:
        readings = readings_of(case, problem, at)
        if problem.objectives:
            return float(scaled(problem, readings, (Minimize,))[0][0])
        return 0.0 if as_limits else float(np.sum(np.concatenate(scaled(problem, readings, MET)) ** 2)) * 1e-4

    kinds = (Limit, *MET) if as_limits or problem.objectives else (Limit,)

    def limited(at: np.ndarray) -> np.ndarray:
        return np.concatenate([np.zeros(0), *scaled(problem, readings_of(case, problem, at), kinds)]) * 1e-2

    low = [-1e-2 if isinstance(goal, MET) else -np.inf
           for goal in problem.goals if isinstance(goal, kinds) for _ in goal.linear()[0]]  # fmt: skip
    conditions = [NonlinearConstraint(limited, low, np.full(len(low), 0.9e-2))] if low else []
    minimize(
        objective, begin, method="COBYQA", bounds=Bounds(np.zeros(len(begin)), np.ones(len(begin))),
        constraints=conditions, options={"initial_tr_radius": 0.2, "final_tr_radius": 2e-3, "maxfev": MOST},
    )  # fmt: skip


def search_least_squares(case: Case, problem: Problem, begin: np.ndarray) -> None:
    """Targets alone, with differences of 2 % of the ranges."""
    least_squares(
        lambda at: np.concatenate(scaled(problem, readings_of(case, problem, at), MET)), begin, bounds=(0, 1),
        diff_step=2e-2,
    )  # fmt: skip


def count(case: Case, method: str) -> int | None:
    """Runs that a method needs."""
    problem, begin = case.problem()
    try:
        if method == "turgor":
            trust_region(problem, begin, studies.Search(most_solves=MOST, slopes=False))
        elif method == "least squares":
            search_least_squares(case, problem, begin)
        else:
            search_cobyqa(case, problem, begin, method.endswith("limits"))
    except DoneError:
        pass
    return case.runs_needed(problem)


def formulas() -> list[Case]:
    true = cases.sphere(12 * mm, 1.6 * mm)
    three = (("inner_stretch", 6 * kPa), ("inner_stretch", 12 * kPa), ("cavity_volume", 6 * kPa))
    sphere = [
        studies.Target(name, float(np.interp(at, true["pressure"], true[name])), at=("pressure", at))
        for name, at in three
    ]
    exact = studies.Target
    ab, start = cases.factors("a", "b"), {"a": -0.5, "b": -0.5}
    height = [studies.Minimize("height")]
    limited = 3 + (0.8 / 3) ** 2 + 2 * (0.4 / 3) ** 2
    names = ["a", "b", "c", "d"]
    length = studies.Factor(name="length", low=40 * mm, high=120 * mm, unit="mm")
    bend = studies.Factor(name="curvature", low=2.0, high=40.0, unit="")
    path = [studies.TipPath([(0.0, 0.0), *tip(20.0, 90 * mm)], tolerance=0.5 * mm)]
    radius = studies.Factor(name="radius", low=5 * mm, high=40 * mm, unit="mm")
    tall = studies.Factor(name="length", low=5 * mm, high=40 * mm, unit="mm")
    least = [studies.Minimize("surface"), studies.Limit("volume", least=10e-6)]
    return [
        Case("sphere, 3 targets by 2", cases.sphere, [cases.RADIUS, cases.WALL], sphere, {}),
        Case("path of a tip by 2", cases.arc, [length, bend], path, {"length": 60 * mm, "curvature": 8.0}),
        Case("bowl by 2", cases.bowl, ab, height, start, lowest=3.0),
        Case("bowl by 2 under a limit", cases.bowl, ab, [*height, studies.Limit("total", most=0.5)], start, limited),
        Case("steep bowl by 4", cases.long_bowl, cases.factors(*names), height, {}, lowest=1.0),
        Case("bowl by 2 with noise", cases.noisy, ab, height, start, lowest=3.0),
        Case("tin of 10 mL by 2", tin, [radius, tall], least, {}, lowest=6 * np.pi * (10e-6 / 2 / np.pi) ** (2 / 3)),
        Case("target height by 2", cases.bowl, ab, [exact("height", 3.2), exact("total", 0.7)], start),
    ]


def tip(curvature: float, length: float) -> list[tuple[float, float]]:
    result = cases.arc(length, curvature)
    return list(zip(result["tip_displacement_x"], result["tip_displacement_z"], strict=True))[1:]


def tin(radius: float, length: float) -> tg.Response:
    """A tin with a volume and a surface."""
    return cases.table(volume=np.pi * radius**2 * length, surface=2 * np.pi * radius * (radius + length))


def tubes(folder: Path) -> list[Case]:
    """A tube of finite elements: its wall and radius from two targets, and the least rubber under a target."""
    (folder / "tube.toml").write_text(calibration_cases.JOB, encoding="utf-8")
    job = job_function(tg.jobs.read_job(folder / "tube.toml"), folder / "search")
    computation = job.computation()
    runs = studies.saved_in(folder / "search" / "runs")
    (true,) = runs.of([computation.run({"actuator.wall": 1.5 * mm, "actuator.inner_radius": 6.5 * mm})])
    names = ("tip_displacement_x", "cavity_volume")
    goals = [studies.Target(name, float(true.result.response[name][-1])) for name in names]
    ranges = (("actuator.wall", 1, 4), ("actuator.inner_radius", 4, 10))
    factors = [studies.Factor(name=name, low=low * mm, high=high * mm, unit="mm") for name, low, high in ranges]
    return [Case("tube of finite elements, 2 targets by 2", computation, factors, goals, {}, evaluations=runs)]


FIT_METHODS = ("turgor", "least squares", "COBYQA")


def fits() -> dict[str, tuple[studies.Trial, list[studies.Parameter]]]:
    """Calibrations of formulas, with a spread that is known or not, a bound, a prior, and what is not determined."""
    stiff, more = studies.Parameter(name="C10", start=0.2e6), studies.Parameter(name="C20", start=0.0, **AROUND_ZERO)
    wall = studies.Parameter(name="wall", start=1.2 * mm)
    known = studies.Parameter(name="wall", start=1.2 * mm, prior=(1 * mm, 0.05 * mm))
    noisy = calibration_cases.measured_sphere(noise=1e-3, C20=0.0)
    far = calibration_cases.measured_sphere(noise=1e-3, seed=3, most=8.5e3)
    near = studies.Parameter(name="C10", start=0.09e6)
    bound = studies.Parameter(name="C10", start=0.2e6, lower=0.15e6)
    line = [studies.Parameter(name="height", start=0.0, lower=-1.0, upper=1.0),
            studies.Parameter(name="slope", start=0.0, lower=-4.0, upper=4.0)]  # fmt: skip
    exact, soft = calibration_cases.measured_sphere(), calibration_cases.measured_sphere(C20=0.0)

    def sphere(measured: tg.Response, **options: object) -> studies.Trial:
        return studies.Trial(measured=measured, function=calibration_cases.thin_sphere, **options)

    line_rows = calibration_cases.measured_line(0.3, 2.0, 0.05)
    return {
        "sphere by 2": (sphere(exact), [stiff, more]),
        "sphere by 2 from another start": (sphere(exact), [near, more]),
        "sphere by 1": (sphere(soft), [stiff]),
        "sphere by 1 to its bound": (sphere(soft), [bound]),
        "stiffness and wall, not determined": (sphere(noisy, spread=1e-3), [stiff, wall]),
        "stiffness and wall with a prior": (sphere(soft), [stiff, known]),
        "sphere by 2 with noise": (sphere(far, values={"up_to": 1.35}), [near, more]),
        "straight line by 2": (
            studies.Trial(measured=line_rows, function=calibration_cases.straight, spread=0.05),
            line,
        ),
    }


AROUND_ZERO = {"lower": -0.05e6, "upper": 0.05e6}


def scipy_fit(objective: Objective, start: np.ndarray, most: int, cobyqa: bool) -> SearchResult:
    """Fit with a search of SciPy, with fresh differences at the end, as the standard errors need."""
    low, high = objective.limits
    best = {"cost": np.inf, "at": start}

    def residuals(at: np.ndarray) -> np.ndarray:
        if len(objective.evaluations.ended) >= most:
            raise DoneError
        result = objective.residuals(np.clip(at, low, high))
        if result @ result < best["cost"]:
            best.update(cost=result @ result, at=np.clip(at, low, high))
        return result

    def jacobian(at: np.ndarray) -> np.ndarray:
        table = objective.jacobian(at)
        if no_step_left(objective, at, residuals(at), table):
            raise DoneError
        return table

    first = float(residuals(start) @ residuals(start))
    try:
        if cobyqa:
            options = {"initial_tr_radius": 0.1, "final_tr_radius": 2e-4, "maxfev": MOST}
            minimize(lambda at: float(residuals(at) @ residuals(at)) / first, start, method="COBYQA",
                     bounds=Bounds(low, high), options=options)  # fmt: skip
        else:
            least_squares(residuals, start, jac=jacobian, bounds=(low, high), ftol=1e-4, xtol=2e-4, gtol=None)
    except DoneError:
        pass
    at = np.asarray(best["at"])
    return SearchResult(at=at, residuals=objective.residuals(at), jacobian=objective.jacobian(at), converged=True)


def fit_main() -> None:
    """Print the runs of calibrations; one that ends at a larger misfit than turgor has, by 2 %, is marked by a star."""
    print("\n| calibration | " + " | ".join(FIT_METHODS) + " |\n|---|" + "---|" * len(FIT_METHODS), flush=True)
    own = calibrate.search
    for name, (trial, free) in fits().items():
        row, misfits = [], []
        for method in FIT_METHODS:
            calibrate.search = own if method == "turgor" else partial(scipy_fit, cobyqa=method == "COBYQA")
            result = calibrate.calibrate(trial, free, most_solves=MOST)
            misfits.append(result.fits[0].rms)
            worse = misfits[-1] > 1.02 * misfits[0] + 1e-3 * result.fits[0].rms_start
            row.append(f"{result.solves}{'*' if worse else ''}")
        print(f"| {name} | " + " | ".join(row) + " |", flush=True)
    calibrate.search = own


METHODS = ("turgor", "COBYQA", "COBYQA, targets as limits", "least squares")


def main(every: list[Case]) -> None:
    print("| case | " + " | ".join(METHODS) + " |", flush=True)
    print("|---|" + "---|" * len(METHODS), flush=True)
    for case in every:
        row = []
        for method in METHODS:
            left_out = method == "least squares" and case.lowest is not None
            left_out = left_out or (method.endswith("limits") and case.lowest is not None)
            row.append("" if left_out else str(count(case, method) or "–"))
        print(f"| {case.name} | " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    with TemporaryDirectory() as temporary:
        main([*formulas(), *tubes(Path(temporary))])
    fit_main()
