"""Claim 6.2-4: where a mesh distorts badly, its density must change between load steps."""

from functools import partial
from typing import Any

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.judging import line_of
from turgor_guidelines.modeling.benders import rubber_of
from turgor_guidelines.values import Value, last

#: Sizes of the cells [mm], and that of the reference.
SIZES, FINEST = (4.0, 2.0, 1.0), 0.5

#: Pressures [kPa] of the tube, which stretch its inner wall 1.1 to 4 times, and of the square bender.
TUBE_PRESSURES = (15.888, 51.609, 77.445, 99.313, 120.303, 141.027, 161.646)
BENDER_PRESSURES = (10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0)

#: Error from which on the mesh counts as too distorted.
TOO_MUCH = 0.01

RUBBER = "elastosil-m4601/yeoh-mosadegh-2014"


def inflate(size: float, bends: bool) -> Computed:
    """Inflate the section of a bare tube, or of a square bender on paper, on one mesh that stays the same."""
    materials: dict[str, Any] = {"body": rubber_of(RUBBER)}
    actuator: Any = tg.actuators.ExtendingCylinder()
    if bends:
        actuator = tg.actuators.RectangularBender(length=100 * mm)
        paper = tg.from_library("paper", record="hooke-polygerinos-2020")
        materials |= {"base": materials["body"], "strain_limiting_layer": tg.Shell(paper, thickness=0.1 * mm)}
    section = tg.Section(actuator, materials, size=size * mm)
    pressures = np.array([0.0, *(BENDER_PRESSURES if bends else TUBE_PRESSURES)]) * kPa
    result = section.solve(pressures, throw=False, mesh_error=False).response
    moved = result.find("curvature_y") if bends else tg.experiments.Column("strain", "", result["stretch"] - 1)
    columns = (
        result.find("pressure"),
        tg.experiments.Column("motion", moved.unit, abs(moved.values)),
        result.find("largest_stretch"),
    )
    return Computed(
        response=tg.Response(columns=columns, source=result.source, status=result.status, message=result.message)
    )


def runs(setting: Setting, bends: bool) -> tuple[Run, ...]:
    """Every size; sections are cheap, so both settings have all."""
    del setting
    return tuple(
        Run(name=f"cells of {size:g} mm", function=inflate, values={"size": size, "bends": bends})
        for size in (*SIZES, FINEST)
    )


def _errors(runs: Runs) -> dict[float, tuple[list[float], list[float]]]:
    """Largest stretch and relative error of the motion in each state, by size."""
    fine = runs[f"cells of {FINEST:g} mm"].response
    errors = {}
    for size in SIZES:
        each = runs[f"cells of {size:g} mm"].response
        count = min(len(each["motion"]), len(fine["motion"]))
        apart = each["motion"][1:count] / fine["motion"][1:count] - 1
        errors[size] = (fine["largest_stretch"][1:count].tolist(), abs(apart).tolist())
    return errors


def judge(runs: Runs, target: float) -> Judgement:
    """A mesh that stays the same stops, or becomes wrong as it distorts; a finer one from the start does so too."""
    stopped = [last(each.response, "pressure").number < target * (1 - 1e-9) for each in runs.values()]
    errors = _errors(runs)
    wrong = [end > TOO_MUCH and end > first for _, (first, *_, end) in errors.values()]
    bad = [a or b for a, b in zip(stopped[:-1], wrong, strict=True)]
    verdict = Verdict.CONFIRMED if all(bad) else Verdict.CONDITIONAL if any(bad) else Verdict.NOT_REPRODUCED
    reach = max(stretches[-1] for stretches, _ in errors.values())
    summary = "; ".join(f"{size:g} mm {first:.2%} to {end:.2%}" for size, (_, (first, *_, end)) in errors.items())
    ends = "every path reached its end" if not any(stopped) else f"{sum(stopped)} of {len(stopped)} paths stopped early"
    return Judgement(
        verdict=verdict,
        finding=f"{ends}, with the rubber stretched {reach:.3g} times; error of the motion against cells of {FINEST:g} "
        f"mm, from the first to the last pressure: {summary}",
        conditions=""
        if all(bad)
        else "Here a mesh that is fine enough from the start serves to the end. The equations refer to the "
        "elements at rest, so that an element that is drawn long is no worse than its shape at rest.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Motion, and its error against the stretch."""
    curves = tuple((name, each.response) for name, each in runs.items())
    lines = [
        line_of(stretches, [Value(100 * each) for each in errors], f"{size:g} mm")
        for size, (stretches, errors) in _errors(runs).items()
    ]
    return (
        tg.pictures.Panel(x="pressure", y="motion", responses=curves),
        tg.pictures.Panel(x="largest stretch of the rubber", y="error of the motion [%]", lines=lines),
    )


EXPECTED = f"A mesh that is not changed on the way stops early, or is off by more than {TOO_MUCH:.0%} in the end."

GUIDELINE = Guideline(
    key="6.2-4",
    rule="If the mesh distorts badly during the simulation, its density needs to change between load steps.",
    sources=("Gent 2012",),
    families=("extending_cylinder", "rectangular_bender"),
    studies=(
        GuidelineTest(
            title="Bare tube that balloons",
            setup="Section of a long tube (inner radius 6.35 mm, wall 2 mm, closed ends) of Elastosil M4601 (Yeoh, "
            "0.11 and 0.02 MPa), inflated until its inner wall is stretched four times and a square element there is "
            "forty times as wide as thick; extension.",
            expected=EXPECTED,
            runs=partial(runs, bends=False),
            judge=partial(judge, target=TUBE_PRESSURES[-1]),
            panels=panels,
        ),
        GuidelineTest(
            title="Square bender whose corners open",
            setup="Section of a rectangular bender on paper without hoops, of the same rubber; its inner corners are "
            "stretched most; curvature.",
            expected=EXPECTED,
            runs=partial(runs, bends=True),
            judge=partial(judge, target=BENDER_PRESSURES[-1]),
            panels=panels,
        ),
    ),
)
