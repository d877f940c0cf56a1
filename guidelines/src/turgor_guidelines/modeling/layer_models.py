"""Claim 5-4: a strain-limiting layer is a thin layer of solid in the model, or a surface with a thickness."""

from typing import Any

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import MPa, kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import change, line_of, verdict_of
from turgor_guidelines.sections import solved_twice
from turgor_guidelines.values import Value, last

#: Young's modulus of the layer [MPa] by its thickness [mm]: the same stiffness in its plane.
LAYERS = {0.1: 1000.0, 0.5: 200.0, 1.0: 100.0}

#: Outside of the section and its void [mm], and the pressures [kPa].
WIDTH, HEIGHT, VOID_WIDTH, VOID_HEIGHT, FLOOR = 16.0, 14.0, 10.0, 8.0, 3.0
PRESSURES = (0, 10, 20, 30)

#: Difference that is read as none.
SAME = 0.05

FORMS = ("solid", "membrane", "shell")


def bend(form: str, thickness: float, size: float) -> Computed:
    """Bend a rectangular section whose lowest layer is stiff: a region of solid, a membrane or a shell."""
    young = LAYERS[thickness] * MPa
    lowest = -thickness * mm if form == "solid" else 0.0
    half, inner = WIDTH / 2 * mm, VOID_WIDTH / 2 * mm
    areas: dict[str, Any] = {"body": tg.sections.rectangle((-half, half), (lowest, HEIGHT * mm))}
    rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    materials: dict[str, Any] = {"body": rubber}
    if form == "solid":
        areas["layer"] = tg.sections.rectangle((-half, half), (lowest, 0.0))
        materials["layer"] = tg.Material(name="layer", law=tg.laws.NeoHooke(C10=young / 6))
    else:
        sheet = tg.Material(name="layer", law=tg.laws.Hooke(E=young, nu=0.49))
        materials["layer"] = (tg.Shell if form == "shell" else tg.Membrane)(sheet, thickness=thickness * mm)
    areas["cavity"] = tg.sections.rectangle((-inner, inner), (FLOOR * mm, (FLOOR + VOID_HEIGHT) * mm))
    lines = {} if form == "solid" else {"layer": ("z", 0.0)}
    sketch = tg.sections.Sketch(areas=areas, lines=lines)
    return solved_twice(
        lambda cells: tg.Section(sketch, materials, size=cells).solve(
            np.array(PRESSURES) * kPa, throw=False, mesh_error=False
        ),
        size * mm,
    )


def runs(setting: Setting) -> tuple[Run, ...]:
    """Every form and thickness; sections are cheap, so both settings have all."""
    size = 1.5 if setting == "quick" else 0.75
    return tuple(
        Run(
            name=f"{form}, {thickness:g} mm",
            function=bend,
            values={"form": form, "thickness": thickness, "size": size},
        )
        for thickness in LAYERS
        for form in FORMS
    )


def _curvatures(runs: Runs, form: str) -> list[Value]:
    return [last(runs[f"{form}, {thickness:g} mm"].response, "curvature_y") for thickness in LAYERS]


def judge(runs: Runs) -> Judgement:
    """Membrane and shell bend as the solid layer does."""
    solid = _curvatures(runs, "solid")
    holds, parts, apart = [], [], []
    for form in FORMS[1:]:
        changes = [change(value, rest) for value, rest in zip(_curvatures(runs, form), solid, strict=True)]
        holds += [abs(each) < SAME for each in changes]
        parts.append(f"{form} {', '.join(f'{each:+.1%}' for each in changes)}")
        apart += [
            f"{form} of {thickness:g} mm" for thickness, each in zip(LAYERS, changes, strict=True) if abs(each) >= SAME
        ]
    sizes = ", ".join(f"{each:g}" for each in LAYERS)
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"Curvature at {PRESSURES[-1]} kPa against that with a solid layer, layers of {sizes} mm: "
        f"{'; '.join(parts)}.",
        conditions=f"More than {SAME:.0%} apart: {', '.join(apart)}. A thick layer has its middle half a thickness "
        "below the face that carries the sheet."
        if apart
        else "",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature against the thickness, for each form."""
    lines = [line_of(list(LAYERS), _curvatures(runs, form), form) for form in FORMS]
    return (
        tg.pictures.Panel(x="thickness of the layer [mm]", y=f"curvature at {PRESSURES[-1]} kPa [1/m]", lines=lines),
    )


GUIDELINE = Guideline(
    key="5-4",
    rule="The strain-limiting layer can be modeled as a thin layer of solid, or as a surface that has a thickness.",
    sources=("Xavier, Fleming and Yong 2021",),
    families=("rectangular_bender", "fast_pneunet"),
    studies=(
        GuidelineTest(
            title="Solid, membrane and shell of equal stiffness",
            setup=f"Section of {WIDTH:g} x {HEIGHT:g} mm, void of {VOID_WIDTH:g} x {VOID_HEIGHT:g} mm, its floor "
            f"{FLOOR:g} mm thick, Elastosil M4601 (Yeoh, 0.11 and 0.02 MPa), below it a layer of 100 N/mm; "
            f"curvature up to {PRESSURES[-1]} kPa.",
            expected=f"All three within {SAME:.0%}.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
