"""Closed forms that the tests of calibration and uncertainty call, some in other processes."""

from pathlib import Path

import numpy as np

import turgor as tg
from turgor.cli.analyses.stated import free_factors
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.study_file.calibrate_table import parameter_of
from turgor.units import kPa, mm

#: Values at which experiments are made up.
TRUE = {"C10": 0.12e6, "C20": 0.004e6}
RADIUS, WALL = 20 * mm, 1 * mm


#: A job that takes a fraction of a second.
JOB = """
[actuator]
type = "extending_cylinder"
length = "20 mm"
cap = "3 mm"

[mesh]
cells = "axisymmetric"
size = "3 mm"
wall_cells = 1

[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa" }

[loads]
pressure = "20 kPa"

[output]
measures = ["tip_displacement_x", "cavity_volume"]
"""


def response(pressure, stretch, text="a sphere"):
    columns = Column("pressure", "kPa", pressure), Column("stretch", "", stretch)
    return Response(columns=columns, source=Source(text=text))


def thin_sphere(
    C10: float = 0.12e6, C20: float = 0.0, wall: float = WALL, up_to: float = 1.3, log: str = ""
) -> Response:
    """Pressure of a thin sphere of a Yeoh rubber: P = 4 t/R (C10 + 2 C20 (I1 - 3)) (1/λ - 1/λ⁷)."""
    if log:
        with Path(log).open("a", encoding="utf-8") as file:
            file.write(f"{C10} {C20} {wall}\n")
    stretch = np.linspace(1.0, up_to, 60)
    first = 2 * stretch**2 + stretch**-4 - 3
    pressure = 4 * wall / RADIUS * (C10 + 2 * C20 * first) * (1 / stretch - stretch**-7)
    return response(pressure, stretch)


def measured_sphere(noise=0.0, seed=0, rows=25, offset=0.0, most=None, **values):
    """What a rig measures: the widening at steady pressures, with noise, and a gauge that shows too little."""
    exact = thin_sphere(**{**TRUE, **values})
    at = np.linspace(0.0, most or exact["pressure"][-1] * 0.98, rows)
    stretch = np.interp(at, exact["pressure"], exact["stretch"])
    draws = np.random.default_rng(seed).standard_normal(rows)
    return response(at - offset, stretch + noise * draws, "rig")


def straight(height: float, slope: float) -> Response:
    """A straight line."""
    x = np.array([0.0, 5e3, 10e3])
    return Response(
        columns=(Column("pressure", "kPa", x), Column("force", "N", height + slope * x / 10e3)),
        source=Source(text="a line"),
    )


def measured_line(height, slope, noise, seed=0, rows=20):
    x = np.linspace(0.0, 10e3, rows)
    y = height + slope * x / 10e3 + noise * np.random.default_rng(seed).standard_normal(rows)
    return Response(columns=(Column("pressure", "kPa", x), Column("force", "N", y)), source=Source(text="load cell"))


def breaks_when_soft(C10: float) -> Response:
    """A run that fails below 0.1 MPa."""
    if C10 < 0.1e6:
        raise TurgorError("the path ended at its first step.")
    return thin_sphere(C10)


def ends_early(C10: float) -> Response:
    """A sphere under pressure: its path ends at 12 kPa."""
    whole = thin_sphere(C10)
    kept = whole["pressure"] <= 12 * kPa
    return Response(
        columns=tuple(Column(each.name, each.unit, each.values[kept]) for each in whole.columns),
        source=whole.source,
        message="The pressure could not rise past 12 kPa.",
    )


def widening(C10: float) -> Response:
    """Another experiment with the same rubber: a sphere of another wall."""
    return thin_sphere(C10, wall=2 * WALL)


def thick_sphere(C10: float = 0.12e6, wall: float = 5 * mm, inner_radius: float = 10 * mm) -> Response:
    """The formula of a thick sphere, at pressures up to 60 kPa."""
    rubber = tg.Material(name="test rubber", law=tg.laws.NeoHooke(C10=C10))
    ball = tg.formulas.HollowSphere(inner_radius=inner_radius, wall=wall)
    return tg.formulas.thick_sphere(ball, rubber, np.linspace(10 * kPa, 60 * kPa, 6))


def free_parameters(free, priors, job):
    """The parameters of a job that options of the command line state."""
    return tuple(parameter_of(key, given, job.numbers) for key, given in free_factors(free, priors).items())
