"""Claim 8.1-8: gravity changes where soft manipulators of several segments reach, because they are compliant."""

from typing import Any

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.judging import line_of
from turgor_guidelines.modeling.benders import rubber_of
from turgor_guidelines.values import Value, last

#: Rubbers with the pressure that bends one segment by the same share of its stiffness [kPa].
RUBBERS = {
    "Ecoflex 00-30": ("ecoflex-00-30/yeoh-kulkarni-2015", 15),
    "Elastosil M4601": ("elastosil-m4601/neo-hooke-polygerinos-2020", 142),
}

#: Length of one segment over its diameter of 20 mm, and the segments of the arm.
SLENDERNESS, SEGMENTS, RADIUS = (2, 4, 6), 2, 10.0

#: Distance between tips with and without gravity, over the length of the arm, that counts.
COUNTS = 0.1


def arm(rubber: str, pressure: float, slenderness: float, gravity: bool) -> Computed:
    """Horizontal arm of two segments that bend upwards by a pressure [kPa]; the path of its tip."""
    material = rubber_of(rubber)
    solid = tg.rods.RodSection.from_geometry(tg.rods.Round(radius=RADIUS * mm), material)
    chambers = [tg.rods.RodChamber(name="low", area=50 * mm**2, offset=(0, -6 * mm))]
    section = tg.rods.RodSection(
        stiffness=solid.stiffness, mass_per_length=solid.mass_per_length, chambers=tuple(chambers)
    )
    length = slenderness * 2 * RADIUS * mm
    joints = ["base", *(f"joint_{k}" for k in range(1, SEGMENTS)), "tip"]
    pieces = [
        tg.rods.Rod(name=f"part_{k}", section=section, length=length, start=joints[k], end=joints[k + 1])
        for k in range(SEGMENTS)
    ]
    loads: list[Any] = [
        tg.rods.ChamberPressure(
            chamber="low", rod=piece.name, pressure=pressure * kPa, history=((0, 0), (0.2, 0), (1, 1))
        )
        for piece in pieces
    ]
    if gravity:
        loads.append(tg.Gravity((0, 0, -1), history=((0, 0), (0.2, 1), (1, 1))))
    plates = [tg.rods.Plate(name="base", support="fixed"), *(tg.rods.Plate(name=name) for name in joints[1:])]
    response = tg.rods.static(tg.rods.RodModel(rods=pieces, plates=plates, loads=loads), at=10).response()
    whole = SEGMENTS * length
    columns = [response.find("load_factor")]
    columns += [tg.experiments.Column(f"tip_{axis}", "", response[f"tip_displacement_{axis}"] / whole) for axis in "xz"]
    reduced = tg.Response(
        columns=tuple(columns), source=response.source, status=response.status, message=response.message
    )
    return Computed(response=reduced)


def runs(setting: Setting) -> tuple[Run, ...]:
    """Both rubbers, short and long, with gravity and without; rods are cheap."""
    del setting
    return tuple(
        Run(
            name=f"{name}, {2 * slenderness} diameters, {'with' if gravity else 'without'} gravity",
            function=arm,
            values={"rubber": rubber, "pressure": pressure, "slenderness": slenderness, "gravity": gravity},
        )
        for name, (rubber, pressure) in RUBBERS.items()
        for slenderness in SLENDERNESS
        for gravity in (False, True)
    )


def _apart(runs: Runs) -> dict[str, float]:
    """Distance between both tips over the length of the arm, at the full pressure."""
    names = list(runs)
    out = {}
    for without, with_ in zip(names[::2], names[1::2], strict=True):
        tips = [[last(runs[name].response, f"tip_{axis}").number for axis in "xz"] for name in (without, with_)]
        out[without.rsplit(",", 1)[0]] = float(np.linalg.norm(np.subtract(tips[0], tips[1])))
    return out


def judge(runs: Runs) -> Judgement:
    """Distances beyond what counts, and for which arms."""
    apart = _apart(runs)
    far = [name for name, size in apart.items() if size > COUNTS]
    verdict = (
        Verdict.NOT_REPRODUCED if not far else Verdict.CONFIRMED if len(far) == len(apart) else Verdict.CONDITIONAL
    )
    return Judgement(
        verdict=verdict,
        finding="distance between the tips with and without gravity over the length of the arm: "
        + ", ".join(f"{name} {size:.0%}" for name, size in apart.items()),
        conditions=f"More than {COUNTS:.0%} for: {'; '.join(far)}. The sag grows with density times length cubed "
        f"over modulus "
        "times diameter squared."
        if far
        else "",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Paths of the tips, and the distances against the length."""
    shown = tuple((name, each.response) for name, each in runs.items() if f"{2 * SLENDERNESS[1]} diameters" in name)
    apart = _apart(runs)
    lines = [
        line_of(
            [2 * s for s in SLENDERNESS], [Value(100 * apart[f"{name}, {2 * s} diameters"]) for s in SLENDERNESS], name
        )
        for name in RUBBERS
    ]
    return (
        tg.pictures.Panel(x="tip_x", y="tip_z", responses=shown),
        tg.pictures.Panel(x="length over diameter", y="distance of the tips [% of the length]", lines=lines),
    )


GUIDELINE = Guideline(
    key="8.1-8",
    rule="Gravity has a large influence on soft manipulators of several segments: they do not reach the larger "
    "workspace that "
    "a model without it predicts.",
    sources=("Peng et al. 2019",),
    families=("omnidirectional_actuator", "three_extenders"),
    studies=(
        GuidelineTest(
            title="Horizontal arm of two segments",
            setup="Cosserat rods of 20 mm diameter with one chamber of 50 mm² 6 mm below the axis, which fibers "
            "keep from "
            "bulging, clamped horizontally, 4 to 12 diameters long; Ecoflex 00-30 or Elastosil M4601, pressures in "
            "proportion to "
            "their moduli; weight of the silicone on or off.",
            expected=f"The tips are more than {COUNTS:.0%} of the length apart.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
