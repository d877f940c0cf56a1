"""Claims 8.1-1 and 8.1-2: constants of another rubber, and the spread of published ones, change what is predicted."""

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.judging import line_of
from turgor_guidelines.modeling.benders import BENDER, bender
from turgor_guidelines.values import Value, at, listed

#: Pressure of the comparison [kPa].
PRESSURE = 2

#: Constants of Ecoflex 00-30 and 00-50, and those that were taken from Elastosil M4601.
BORROWED = {
    "Ecoflex 00-30, Kulkarni": "ecoflex-00-30/yeoh-kulkarni-2015",
    "Ecoflex 00-30, as Yan et al.": "ecoflex-00-30/yeoh-yan-2016",
    "Ecoflex 00-50, Kulkarni": "ecoflex-00-50/yeoh-kulkarni-2015",
    "Ecoflex 00-50, as Xue et al.": "ecoflex-00-50/yeoh-xue-2018",
}

#: Published constants of Ecoflex 00-30 that were not borrowed.
PUBLISHED = {
    "Kulkarni, Yeoh": "ecoflex-00-30/yeoh-kulkarni-2015",
    "Polygerinos, Yeoh": "ecoflex-00-30/yeoh-polygerinos-2015",
    "Steck, Yeoh": "ecoflex-00-30/yeoh-steck-2019",
    "Agarwal, Ogden": "ecoflex-00-30/ogden-agarwal-2016",
    "Moseley, Ogden": "ecoflex-00-30/ogden-moseley-2016",
    "Steck, Ogden": "ecoflex-00-30/ogden-steck-2019",
}

#: Hoops and fabric are threads that go slack, all but a little that keeps the solve short.
SLACK = (0.02, 0.02)

#: Relative differences that count as substantial.
SUBSTANTIAL = 0.25


def _runs(rubbers: dict[str, str], setting: Setting) -> tuple[Run, ...]:
    size = 2.0 if setting == "quick" else 1.0
    return tuple(
        Run(
            name=name,
            function=bender,
            values={"rubber": rubber, "pressure": PRESSURE, "size": size, "compression": list(SLACK)},
        )
        for name, rubber in rubbers.items()
    )


def borrowed(setting: Setting) -> tuple[Run, ...]:
    """Own and borrowed constants."""
    return _runs(BORROWED, setting)


def published(setting: Setting) -> tuple[Run, ...]:
    """All constants of one rubber."""
    return _runs(PUBLISHED, setting)


def _angles(runs: Runs) -> dict[str, Value]:
    return {name: at(each.response, "bending_angle", "pressure", PRESSURE * kPa) for name, each in runs.items()}


def judge_borrowed(runs: Runs) -> Judgement:
    """How far borrowed constants are from own ones."""
    angles = list(_angles(runs).values())
    ratios = [b.number / a.number for a, b in zip(angles[::2], angles[1::2], strict=True)]
    far = all(abs(ratio - 1) > SUBSTANTIAL for ratio in ratios)
    return Judgement(
        verdict=Verdict.CONFIRMED if far else Verdict.NOT_REPRODUCED,
        finding=f"{', '.join(runs)}: {listed(angles)} at {PRESSURE} kPa; with the borrowed constants the angle is "
        + " and ".join(f"{ratio:.2g}" for ratio in ratios)
        + " times that with constants of the rubber itself",
    )


def judge_published(runs: Runs) -> Judgement:
    """How far published constants of one rubber are from each other."""
    angles = _angles(runs)
    low, high = min(angles, key=lambda n: angles[n].number), max(angles, key=lambda n: angles[n].number)
    stretch = max(at(each.response, "largest_stretch", "pressure", PRESSURE * kPa).number for each in runs.values())
    spread = angles[high].number / angles[low].number - 1
    return Judgement(
        verdict=Verdict.CONFIRMED if spread > SUBSTANTIAL else Verdict.NOT_REPRODUCED,
        finding=f"{', '.join(runs)}: {listed(list(angles.values()))} at {PRESSURE} kPa; {high} bends {spread:.0%} "
        f"further "
        f"than {low}",
        conditions=f"The rubber is stretched {stretch:.2f} times at most there. Records with borrowed constants, "
        f"and the one "
        "whose law is unstable from the start, are left out.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves, and angles."""
    curves = tuple((name, each.response) for name, each in runs.items())
    angles = _angles(runs)
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=curves),
        tg.pictures.Panel(
            x="constants",
            y=f"bending angle at {PRESSURE} kPa [deg]",
            lines=[line_of(list(angles), list(angles.values()))],
        ),
    )


GUIDELINE = Guideline(
    key="8.1-1",
    rule="Constants of another rubber, and the large differences between published constants of one rubber, hinder "
    "realistic "
    "predictions.",
    sources=("Yan et al. 2016", "Xue et al. 2018", "Steck et al. 2019"),
    families=("fiber_reinforced_bender",),
    studies=(
        GuidelineTest(
            title="Constants of another rubber",
            setup=BENDER
            + ", threads that go slack but for 2 % of their stiffness; Ecoflex by its own constants, and by those "
            "of Elastosil M4601, with which two publications "
            "computed it.",
            expected=f"Angles at {PRESSURE} kPa more than {SUBSTANTIAL:.0%} apart.",
            runs=borrowed,
            judge=judge_borrowed,
            panels=panels,
        ),
        GuidelineTest(
            title="Six published sets of constants of Ecoflex 00-30",
            setup=BENDER
            + ", threads that go slack but for 2 % of their stiffness; Ecoflex 00-30 by six records of the library.",
            expected=f"Angles at {PRESSURE} kPa more than {SUBSTANTIAL:.0%} apart.",
            runs=published,
            judge=judge_published,
            panels=panels,
        ),
    ),
)
