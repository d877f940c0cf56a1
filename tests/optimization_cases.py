"""Formulas that the tests of optimizations call, some in other processes."""

from dataclasses import replace
from pathlib import Path

import numpy as np

import turgor as tg
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.units import kPa, mm


def table(**columns: float) -> Response:
    """A response of one state."""
    shown = tuple(Column(name, "", [value]) for name, value in columns.items())
    return Response(columns=shown, source=Source(text="a formula"))


def bowl(a: float, b: float, log: str = "", refused_above: float = 9.0) -> Response:
    """A quadratic bowl with its bottom of 3 at (0.3, 0.6), and the sum of its arguments."""
    if log:
        with Path(log).open("a", encoding="utf-8") as file:
            file.write(f"{a} {b}\n")
    if a > refused_above:
        raise TurgorError(f"a is {a:g}; allowed is up to {refused_above:g}.")
    return table(height=3 + (a - 0.3) ** 2 + 2 * (b - 0.6) ** 2, total=a + b)


def counted(count: int, x: float) -> Response:
    """Lowest at 4 whole pieces and x = 0.4."""
    return table(height=1 + (count - 4.4) ** 2 + (x - count / 10) ** 2)


def noisy(a: float, b: float) -> Response:
    """The bowl with the noise of a mesh: 0.1 % of its height, the same for the same arguments."""
    height = float(bowl(a, b)["height"][0])
    return table(height=height * (1 + 1e-3 * np.sin(3917 * a + 7919 * b)))


def two_hills(x: float, y: float) -> Response:
    """Squares of the distances from (0, 0) and (1, 0): no design beats those on the line between them."""
    return table(left=x**2 + y**2, right=(x - 1) ** 2 + y**2)


def two_valleys(x: float, y: float, log: str = "") -> Response:
    """Two minima near (−1, 0.5) and (1, 0.5), of which the left one is lower by 0.6: (x² − 1)² + 0.3 x + (y − 0.5)²."""
    if log:
        with Path(log).open("a", encoding="utf-8") as file:
            file.write(f"{x} {y}\n")
    return table(height=(x**2 - 1) ** 2 + 0.3 * x + (y - 0.5) ** 2, x=x)


def sphere(inner_radius: float, wall: float) -> Response:
    """Inflated sphere of a rubber; its pressure is proportional to the wall where this is thin."""
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))
    shape = tg.formulas.HollowSphere(inner_radius=inner_radius, wall=wall)
    return tg.formulas.thick_sphere(shape, rubber, np.linspace(0.5 * kPa, 20 * kPa, 40))


def arc(length: float, curvature: float) -> Response:
    """The tip of a finger that bends to a circle, at four pressures."""
    share = np.linspace(0, 1, 5)
    angle = share * curvature * length
    radius = length / np.where(angle > 0, angle, 1.0)
    columns = (
        Column("pressure", "kPa", 40 * kPa * share),
        Column("tip_displacement_x", "mm", np.where(angle > 0, radius * np.sin(angle) - length, 0.0)),
        Column("tip_displacement_z", "mm", np.where(angle > 0, radius * (1 - np.cos(angle)), 0.0)),
    )
    return Response(columns=columns, source=Source(text="a circle"))


def factors(*names: str, low: float = -1.0, high: float = 1.0) -> list[tg.studies.Factor]:
    """Numbers without unit."""
    return [tg.studies.Factor(name=name, low=low, high=high) for name in names]


WALL = tg.studies.Factor(name="wall", low=0.5 * mm, high=4 * mm, unit="mm")
RADIUS = tg.studies.Factor(name="inner_radius", low=5 * mm, high=30 * mm, unit="mm")


def long_bowl(**values: float) -> Response:
    """A bowl in any number of dimensions that is a hundred times as steep along the last as along the first."""
    names = sorted(values)
    steep = np.geomspace(1, 100, len(names))
    away = np.array([values[name] for name in names]) - np.linspace(-0.5, 0.5, len(names))
    return table(height=1 + float(steep @ away**2))


def sloped_bowl(**values: float) -> Response:
    """The same with its slopes."""
    names = sorted(values)
    steep = np.geomspace(1, 100, len(names))
    away = np.array([values[name] for name in names]) - np.linspace(-0.5, 0.5, len(names))
    slopes = dict(zip(names, 2 * steep * away, strict=True))
    return tg.studies.with_slopes(long_bowl(**values), {"height": slopes})


def half_sloped_bowl(**values: float) -> Response:
    """The same with slopes by some of its arguments."""
    known = sloped_bowl(**values)
    kept = tuple(each for each in known.columns if each.name not in ("height_slope_a", "height_slope_c"))
    return Response(columns=kept, source=known.source)


def two_cavities(length: float, wall: float, left: float, right: float) -> Response:
    """A beam that bends with the difference of two pressures and stretches with their sum, as length²/wall."""
    share = 1e-8 * length**2 / (60 * mm) / wall
    ends = (share * (left + right), share * (left - right), 0.0)
    names = ("tip_displacement_x", "tip_displacement_y", "tip_displacement_z")
    columns = tuple(Column(name, "mm", [0.0, end]) for name, end in zip(names, ends, strict=True))
    return Response(columns=columns, source=Source(text="a beam"))


PRESSURES = (0.0, 10 * kPa, 20 * kPa)


def reach_of_two_cavities(length: float, wall: float) -> Response:
    """The workspace of the beam, the stress of its wall and its rubber."""
    pressures = {"left": PRESSURES, "right": PRESSURES}
    runs = tg.studies.workspace_of(two_cavities, pressures, values={"length": length, "wall": wall})
    result = runs.to_response()
    stress = Column("stress", "kPa", [20 * kPa * 8 * mm / wall])
    rubber = Column("rubber", "mL", [length * wall * 50 * mm])
    return replace(result, columns=(*result.columns, stress, rubber))
