"""Guideline 7.1-7: a half-round bender bends further with a larger radius and with a larger length."""

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.parts import elastosil, fabric, threads
from turgor_guidelines.pictures import picture_of
from turgor_guidelines.single_chamber.half_round import BARE, BENDER, HOOPED, bend, cells
from turgor_guidelines.single_chamber.shapes import bend_on_plate
from turgor_guidelines.values import largest, last, listed, rises

#: Radii of the chamber [mm], lengths of whole benders [mm], pressures of both [kPa].
RADII, LENGTHS, SECTION_PRESSURE, WHOLE_PRESSURE = (6.0, 8.0, 10.0, 12.0), (30.0, 40.0, 60.0), 20.0, 10.0

#: Walls and base of 2 mm for all radii, or a quarter of the radius; what is around it besides.
KEPT, SCALED, FLAT = "walls of 2 mm", "walls of a quarter radius", "hoops and plate"


def radius_runs(setting: Setting) -> tuple[Run, ...]:
    """Sections of growing radius, bare, in hoops, and in hoops on a plate, whose walls stay or grow with them."""
    return tuple(
        _radius_run(around, walls, radius, cells(setting))
        for around in (BARE, HOOPED, FLAT)
        for walls in (KEPT, SCALED)
        for radius in RADII
    )


def _radius_run(around: str, walls: str, radius: float, cell: float) -> Run:
    wall = 2.0 if walls == KEPT else radius / 4
    values = {"radius": radius, "wall": wall, "pressure": SECTION_PRESSURE, "size": cell * wall / 2.0}
    name = f"{around}, {walls}, radius {radius:g} mm"
    if around == FLAT:
        return Run(name=name, function=bend_on_plate, values=values | {"size": 1.5 * values["size"]})
    return Run(name=name, function=bend, values=values | {"base": wall, "hooped": around == HOOPED})


def _groups(runs: Runs) -> dict[str, list[str]]:
    out: dict[str, list[str]] = {}
    for name in runs:
        out.setdefault(name.rpartition(", ")[0], []).append(name)
    return out


def judge_radius(runs: Runs) -> Judgement:
    """Larger radius, larger curvature, in each of four ways."""
    texts, grown, good = [], [], {}
    for group, names in _groups(runs).items():
        bends = [last(runs[name].response, "curvature_y") for name in names]
        good[group] = rises(bends)
        texts.append(f"{group}: {listed(bends)}")
        more = bends[-1].number / bends[0].number
        grown.append(f"{more:.2f} times as large, most at {RADII[largest(bends)]:g} mm ({group})")
    right = [group for group, each in good.items() if each]
    verdict = Verdict.CONFIRMED if len(right) == len(good) else Verdict.CONDITIONAL
    return Judgement(
        verdict=verdict if right else Verdict.NOT_REPRODUCED,
        finding=f"Curvature at {SECTION_PRESSURE:g} kPa for radii of {', '.join(f'{each:g}' for each in RADII)} mm: "
        + "; ".join(texts)
        + ".",
        conditions=f"The curvature rises with the radius with {' and '.join(right) or 'none of them'}. From "
        f"{RADII[0]:g} to {RADII[-1]:g} mm it becomes {'; '.join(grown)}. Sections that are scaled in all their "
        "parts bend in inverse proportion to their size at the same pressure, so that the wall must become thinner "
        "relative to the radius for a larger one to bend further.",
    )


def radius_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curvature against the radius, bare and in hoops."""
    drawn = []
    for around in (BARE, HOOPED, FLAT):
        lines = []
        for group, names in _groups(runs).items():
            if group.partition(", ")[0] == around:
                bends = [last(runs[name].response, "curvature_y") for name in names]
                error = [each.error for each in bends]
                label = group.partition(", ")[2]
                lines.append(tg.pictures.Line(x=RADII, y=[each.number for each in bends], error=error, label=label))
        drawn.append(
            tg.pictures.Panel(
                x="radius of the chamber [mm]", y=f"{around}: curvature at {SECTION_PRESSURE:g} kPa [1/m]", lines=lines
            )
        )
    return tuple(drawn)


def bend_whole(length: float, size: float) -> Computed:
    """Bend a whole half-round bender of a length [mm] in hoops, in hexahedra of a size [mm]."""
    shape = tg.actuators.FiberReinforcedBender(length=length * mm, skin=0.0)
    model = tg.Model(
        tg.mesh(shape.build(), size=size * mm, cells="hexahedra"),
        {"body": elastosil()},
        [tg.Fixed("fixed")],
        [tg.Pressure("cavity", WHOLE_PRESSURE * kPa)],
        reinforcements=[*fabric(), threads(("outside", "strain_limiting_layer"))],
    )
    solution = tg.solve(model, tg.Static(first_step=0.5), throw=False)
    return Computed(response=tg.measure(solution, tg.bending_angle), picture=picture_of(solution))


def length_runs(setting: Setting) -> tuple[Run, ...]:
    """Whole benders of three lengths."""
    size = 8.0 if setting == "quick" else 4.0
    return tuple(
        Run(name=f"{length:g} mm", function=bend_whole, values={"length": length, "size": size}) for length in LENGTHS
    )


def judge_length(runs: Runs) -> Judgement:
    """Longer, larger angle; and how the angle of a length grows."""
    angles = [last(each.response, "bending_angle") for each in runs.values()]
    each_mm = [angle.number / length for angle, length in zip(angles, LENGTHS, strict=True)]
    return Judgement(
        verdict=Verdict.CONFIRMED if rises(angles) else Verdict.NOT_REPRODUCED,
        finding=f"{', '.join(runs)}: bending angle {listed(angles)} at {WHOLE_PRESSURE:g} kPa.",
        conditions=f"The angle grows {'faster' if each_mm[-1] > each_mm[0] else 'more slowly'} than the length: "
        f"{', '.join(f'{each:.3f}' for each in each_mm)} deg for each mm. The ends bend less than the middle, and the "
        "stiff fabric carries that far: see the section of V21 in the verification.",
    )


def length_panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Angle against pressure, and against the length."""
    angles = [last(each.response, "bending_angle") for each in runs.values()]
    error = [each.error for each in angles]
    line = tg.pictures.Line(x=LENGTHS, y=[each.number for each in angles], error=error)
    return (
        tg.pictures.Panel(
            x="pressure", y="bending_angle", responses=tuple((name, each.response) for name, each in runs.items())
        ),
        tg.pictures.Panel(x="length [mm]", y=f"bending angle at {WHOLE_PRESSURE:g} kPa [deg]", lines=[line]),
    )


GUIDELINE = Guideline(
    key="7.1-7",
    rule="Semicircular actuators reach higher bending angles with a larger radius and with a larger length.",
    sources=("Polygerinos et al. 2015",),
    families=("semicircular_bender", "fiber_reinforced_bender"),
    studies=(
        GuidelineTest(
            title="Radius of the chamber",
            setup=f"{BENDER}; radii of 6 to 12 mm, walls and base of 2 mm or of a quarter of the radius; or without "
            "fabric, in hoops, with the lower half of the base as a plate (C10 = 50 MPa), which stays flat; "
            "curvature at 20 kPa, to which the angle of a length is proportional.",
            expected="The curvature rises with every step to a larger radius.",
            runs=radius_runs,
            judge=judge_radius,
            panels=radius_panels,
        ),
        GuidelineTest(
            title="Length of whole benders",
            setup="Whole half-round benders in hoops, chamber radius 8 mm, wall and base 2 mm, Elastosil M4601 "
            "(neo-Hookean, C10 = 0.12 MPa), fabric of 650 N/mm along and across on the flat side, end walls of 5 "
            "mm, one end fixed; lengths of 30, 40 and 60 mm; bending angle at 10 kPa.",
            expected="The angle rises with every step to a larger length.",
            runs=length_runs,
            judge=judge_length,
            panels=length_panels,
        ),
    ),
)
