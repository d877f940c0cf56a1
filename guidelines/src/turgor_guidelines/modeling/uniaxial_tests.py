"""Claim 8.1-7: constants from uniaxial tests alone may not hold for what pressure does to a wall."""

from typing import Literal

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.modeling.benders import pressures_of, rubber_of
from turgor_guidelines.parts import law_of
from turgor_guidelines.values import Value

#: The rubber whose tests are made from a law, and the laws that are fitted to them.
TRUTHS = {"Moseley": "ecoflex-00-30/ogden-moseley-2016", "Agarwal": "ecoflex-00-30/ogden-agarwal-2016"}
LAWS = ("mooney-rivlin", "yeoh", "ogden-2")
TESTS: dict[str, tuple[Literal["uniaxial", "equibiaxial"], ...]] = {
    "uniaxial": ("uniaxial",),
    "uniaxial and equibiaxial": ("uniaxial", "equibiaxial"),
}

#: Stretch up to which the tests go, and stretch of the inner wall at which pressures are compared.
UNTIL, AT = {"uniaxial": 4.0, "equibiaxial": 2.5}, 2.0

#: Error that counts.
COUNTS = 0.05


def predicted(truth: str, law: str, tests: str) -> Computed:
    """Pressure of a free tube with the law fitted to tests, or with the true law for ``law="truth"``."""
    material = rubber_of(truth)
    if law != "truth":
        samples = []
        for mode in TESTS[tests]:
            stretch = np.linspace(1, UNTIL[mode], 31)[1:]
            stress = tg.laws.curve(law_of(material), mode, stretch).nominal_stress
            samples.append(tg.experiments.MaterialTest(mode=mode, stretch=stretch, nominal_stress=stress, name=mode))
        material = tg.fit(law, samples).material
    else:
        material = tg.Material(name="rubber", law=law_of(material))
    result = tg.formulas.thick_tube(
        tg.actuators.ExtendingCylinder(), material, inner_stretch=np.linspace(1, 2.5, 31)[1:]
    )
    return Computed(response=pressures_of(result["pressure"], result["inner_stretch"], result.source))


def runs(setting: Setting) -> tuple[Run, ...]:
    """The truth, and every law from both sets of tests."""
    del setting
    out = []
    for name, truth in TRUTHS.items():
        out.append(Run(name=f"{name}: truth", function=predicted, values={"truth": truth, "law": "truth", "tests": ""}))
        for law in LAWS:
            for tests in TESTS:
                values = {"truth": truth, "law": law, "tests": tests}
                out.append(Run(name=f"{name}: {law}, {tests}", function=predicted, values=values))
    return tuple(out)


def _error(response: tg.Response, truth: tg.Response) -> float:
    """Error of the pressure at the stretch of the comparison."""
    a, b = (float(np.interp(AT, each["stretch"], each["pressure"] / kPa)) for each in (response, truth))
    return a / b - 1


def _errors(runs: Runs, tests: str) -> dict[str, float]:
    return {
        f"{name}: {law}": _error(runs[f"{name}: {law}, {tests}"].response, runs[f"{name}: truth"].response)
        for name in TRUTHS
        for law in LAWS
    }


def judge(runs: Runs) -> Judgement:
    """Uniaxial tests alone leave an error that counts, and equibiaxial ones reduce it."""
    alone, both = (_errors(runs, tests) for tests in TESTS)
    holds = [abs(alone[name]) > COUNTS and abs(both[name]) < abs(alone[name]) for name in alone]
    harmless = [name for name, size in alone.items() if abs(size) <= COUNTS]
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"error of the pressure of a free tube whose inner wall is stretched {AT:g} times: "
        + ", ".join(f"{name} {size:+.1%} (with equibiaxial tests {both[name]:+.1%})" for name, size in alone.items()),
        conditions=f"Within {COUNTS:.0%} with uniaxial tests alone: {', '.join(harmless)}." if harmless else "",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves of each rubber, and the errors."""
    curves = [
        tg.pictures.Panel(
            x="stretch", y="pressure", responses=tuple((n, e.response) for n, e in runs.items() if n.startswith(name))
        )
        for name in TRUTHS
    ]
    lines = []
    for tests in TESTS:
        errors = _errors(runs, tests)
        lines.append(line_of(list(errors), [Value(100 * size) for size in errors.values()], tests))
    return (*curves, tg.pictures.Panel(x="law", y="error of the pressure [%]", lines=lines))


GUIDELINE = Guideline(
    key="8.1-7",
    rule="Constants from uniaxial tests may not represent the multi-axial stresses in a pressurized actuator.",
    sources=("Xavier et al. 2021", "Marckmann and Verron 2006"),
    families=("extending_cylinder",),
    studies=(
        GuidelineTest(
            title="Laws from one kind of test or two",
            setup="Tests of Ecoflex 00-30 made from two published Ogden laws, uniaxial up to a stretch of 4 and "
            "equibiaxial up "
            "to 2.5; laws fitted to the first kind or to both; pressure of a long free tube (inner radius 6.35 mm, "
            "wall 2 "
            "mm) by formula, against that of the true law.",
            expected=f"More than {COUNTS:.0%} error from uniaxial tests alone, less with both.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
