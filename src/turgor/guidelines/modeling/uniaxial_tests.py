"""Claim 8.1-7: constants from uniaxial tests alone may not hold for what pressure does to a wall."""

from typing import Literal

import numpy as np

import turgor as tg
from turgor.fast_models.formulas.formula import law_of
from turgor.foundation.response import Response
from turgor.guidelines.guideline import Found, Guideline, GuidelineTest, Judgement, Setting
from turgor.guidelines.judging import line_of, verdict_of
from turgor.guidelines.modeling.benders import pressures_of, rubber_of
from turgor.guidelines.values import Value
from turgor.studies.runs.run import Computed, Run
from turgor.units import kPa
from turgor.views.plots.study_figure import Panel

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
        made = []
        for mode in TESTS[tests]:
            stretch = np.linspace(1, UNTIL[mode], 31)[1:]
            stress = tg.laws.curve(law_of(material), mode, stretch).nominal_stress
            made.append(tg.experiments.MaterialTest(mode=mode, stretch=stretch, nominal_stress=stress, name=mode))
        material = tg.fit(law, made).material
    else:
        material = tg.Material(name="rubber", law=material.law)
    found = tg.formulas.thick_tube(
        tg.actuators.ExtendingCylinder(), material, inner_stretch=np.linspace(1, 2.5, 31)[1:]
    )
    return Computed(response=pressures_of(found["pressure"], found["inner_stretch"], found.source))


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


def _error(response: Response, truth: Response) -> float:
    """Error of the pressure at the stretch of the comparison."""
    a, b = (float(np.interp(AT, each["stretch"], each["pressure"] / kPa)) for each in (response, truth))
    return a / b - 1


def _errors(found: Found, tests: str) -> dict[str, float]:
    return {
        f"{name}: {law}": _error(found[f"{name}: {law}, {tests}"].response, found[f"{name}: truth"].response)
        for name in TRUTHS
        for law in LAWS
    }


def judge(found: Found) -> Judgement:
    """Uniaxial tests alone leave an error that counts, and equibiaxial ones reduce it."""
    alone, both = (_errors(found, tests) for tests in TESTS)
    holds = [abs(alone[name]) > COUNTS and abs(both[name]) < abs(alone[name]) for name in alone]
    harmless = [name for name, size in alone.items() if abs(size) <= COUNTS]
    return Judgement(
        verdict=verdict_of(holds),
        found=f"error of the pressure of a free tube whose inner wall is stretched {AT:g} times: "
        + ", ".join(f"{name} {size:+.1%} (with equibiaxial tests {both[name]:+.1%})" for name, size in alone.items()),
        conditions=f"Within {COUNTS:.0%} with uniaxial tests alone: {', '.join(harmless)}." if harmless else "",
    )


def panels(found: Found) -> tuple[Panel, ...]:
    """Curves of each rubber, and the errors."""
    curves = [
        Panel(
            x="stretch", y="pressure", responses=tuple((n, e.response) for n, e in found.items() if n.startswith(name))
        )
        for name in TRUTHS
    ]
    lines = []
    for tests in TESTS:
        errors = _errors(found, tests)
        lines.append(line_of(list(errors), [Value(100 * size) for size in errors.values()], tests))
    return (*curves, Panel(x="law", y="error of the pressure [%]", lines=lines))


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
