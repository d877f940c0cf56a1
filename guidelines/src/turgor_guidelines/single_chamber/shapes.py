"""Sections of one chamber area and wall but different shapes: round, half round, square and rectangles."""

from collections.abc import Mapping
from dataclasses import replace
from math import inf, pi, sqrt
from types import MappingProxyType

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import MPa, kPa, mm
from turgor_guidelines.guideline import Runs, Setting
from turgor_guidelines.parts import FABRIC_SPACING, elastosil, threads
from turgor_guidelines.sections import solved_twice
from turgor_guidelines.values import Value, last

#: Area of every chamber [mm²], that of a half disc of 8 mm radius; wall all around [mm]; last pressure [kPa].
AREA, WALL, PRESSURE = 32 * pi, 2.0, 30.0

#: What the sections are, for the texts of studies.
SETUP = (
    "Sections of long actuators with a chamber of 100.5 mm² and a wall of 2 mm all around: round, half round, square, "
    "rectangles of 2:1 lying and standing; Elastosil M4601 (neo-Hookean, C10 = 0.12 MPa)"
)

ROUND, HALF = "round", "half round"

#: Width over height of the rectangles.
RECTANGLES: Mapping[str, float] = MappingProxyType({"square": 1.0, "lying 2:1": 2.0, "standing 1:2": 0.5})

#: What the bases are called, and the stiffness of a plate, C10 [MPa].
FABRIC, PLATE, NONE, PLATE_C10 = "fabric", "plate", "none", 50.0

SHAPES = (ROUND, HALF, *RECTANGLES)


def outlines(shape: str) -> tuple[tg.sections.Outline, tg.sections.Outline]:
    """Outer and inner outline, the halves with y >= 0 [m]; the outer one stands on z = 0.

    Parameters
    ----------
    shape : str
        One of `SHAPES`.

    Returns
    -------
    tuple of Outline
    """
    if shape == ROUND:
        radius = sqrt(AREA / pi)
        outer, inner = tg.sections.disc((radius + WALL) * mm), tg.sections.disc(radius * mm)
        up = (radius + WALL) * mm
        return outer.moved(z=up).cut_y(), inner.moved(z=up).cut_y()
    if shape == HALF:
        return half_round(sqrt(2 * AREA / pi), WALL)
    width, height = sqrt(AREA * RECTANGLES[shape]), sqrt(AREA / RECTANGLES[shape])
    outer = tg.sections.rectangle((0.0, (width / 2 + WALL) * mm), (0.0, (height + 2 * WALL) * mm))
    return outer, tg.sections.rectangle((0.0, width / 2 * mm), (WALL * mm, (WALL + height) * mm))


def half_round(radius: float, wall: float) -> tuple[tg.sections.Outline, tg.sections.Outline]:
    """Outer and inner outline of half of a half round with a chamber of a radius and a wall all around [mm]."""
    tall = tg.sections.disc((radius + wall) * mm).moved(z=wall * mm).cut_z(0.0)
    return tall.cut_y(), tg.sections.half_disc(radius * mm).moved(z=wall * mm).cut_y()


def bend_on_plate(radius: float, wall: float, pressure: float, size: float) -> Computed:
    """Bend a half round in hoops, the lower half of its base a plate, up to a pressure [kPa]."""
    outer, inner = half_round(radius, wall)
    sketch = tg.sections.Sketch(
        areas={"body": outer, "plate": outer.below_z(wall / 2 * mm), "cavity": inner}, mirrors="y"
    )
    stiff = tg.Material(name="plate", law=tg.laws.NeoHooke(C10=PLATE_C10 * MPa))

    def solve(cell: float) -> tg.sections.SectionSolution:
        materials = {"body": elastosil(), "plate": stiff}
        section = tg.Section(sketch, materials, reinforcements=[threads()], size=cell)
        return section.solve(np.linspace(0, pressure * kPa, 7), throw=False, mesh_error=False)

    return solved_twice(solve, size * mm)


def inflate(shape: str, hooped: bool, base: str, size: float) -> Computed:
    """Inflate a section.

    Parameters
    ----------
    shape : str
        One of `SHAPES`.
    hooped : bool
        Whether hoops are wound around it.
    base : str
        What makes it bend: `FABRIC`, rods along the axis on the lowest 1 mm of its outside, which may bulge; `PLATE`,
        the lowest 1 mm is a stiff plate, which stays flat; `NONE`.
    size : float [mm]
        Of the cells.

    Returns
    -------
    Computed
    """
    outer, inner = outlines(shape)
    plate = {"plate": outer.below_z(1 * mm)} if base == PLATE else {}
    sketch = tg.sections.Sketch(areas={"body": outer, **plate, "cavity": inner}, mirrors="y")
    rods = replace(
        threads(from_axis=0.0, spacing=FABRIC_SPACING),
        compression=1.0,
        within=((-inf, -inf, -inf), (inf, inf, 1 * mm)),
    )
    wound = [threads()] * hooped + [rods] * (base == FABRIC)
    stiff = tg.Material(name="plate", law=tg.laws.NeoHooke(C10=PLATE_C10 * MPa))
    materials = {"body": elastosil(), "plate": stiff} if plate else {"body": elastosil()}

    def solve(cell: float) -> tg.sections.SectionSolution:
        section = tg.Section(sketch, materials, reinforcements=wound, size=cell)
        return section.solve(np.linspace(0, PRESSURE * kPa, 7), throw=False, mesh_error=False)

    return solved_twice(solve, size * mm)


def runs(setting: Setting, ways: tuple[tuple[bool, str], ...]) -> tuple[Run, ...]:
    """All shapes in each way: whether they have hoops, and their base.

    Parameters
    ----------
    setting : {"quick", "full"}
    ways : tuple of (bool, str)

    Returns
    -------
    tuple of Run
    """
    size = 1.5 if setting == "quick" else 0.75
    return tuple(
        Run(
            name=f"{way_name(hooped, base)}, {shape}",
            function=inflate,
            values={"shape": shape, "hooped": hooped, "base": base, "size": size},
        )
        for hooped, base in ways
        for shape in SHAPES
    )


def way_name(hooped: bool, base: str) -> str:
    """How a way is called: ``"hoops and plate"``."""
    around = "hoops" if hooped else "bare"
    return around if base == NONE else f"{around} and {base}"


def by_way(runs: Runs, name: str) -> dict[str, dict[str, Value]]:
    """A column in the last state: by the way, then by the shape."""
    out: dict[str, dict[str, Value]] = {}
    for key, each in runs.items():
        way, shape = key.split(", ")
        out.setdefault(way, {})[shape] = last(each.response, name)
    return out


def bars(runs: Runs, name: str, label: str) -> tg.pictures.Panel:
    """A column of the last state against the shape, a line for each way."""
    lines = [
        tg.pictures.Line(
            x=list(values),
            y=[each.number for each in values.values()],
            error=[each.error for each in values.values()],
            label=way,
        )
        for way, values in by_way(runs, name).items()
    ]
    return tg.pictures.Panel(x="", y=label, lines=lines)
