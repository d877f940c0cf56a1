"""Three-chamber actuators of the guidelines: their sections, with one chamber under pressure."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

import turgor as tg
from turgor.foundation.response import Response
from turgor.guidelines.sliced import bent_section
from turgor.guidelines.values import Value, at
from turgor.studies.runs.run import Computed
from turgor.units import kPa, mm

#: Reference [mm]: three round chambers, those of the reference geometry R4 of the validation targets.
REFERENCE: Mapping[str, Any] = MappingProxyType(
    {"outer_radius": 12.5, "chamber_shape": "circular", "chamber_size": 8, "wall": 2, "bore_radius": 0, "length": 60}
)

#: Distance of the pressures of a path [kPa]; those of the comparisons are among them.
STEP = 10

SETUP = (
    "Cylinder of radius 12.5 mm with three chambers, reference: round, 8 mm wide, 2 mm below the surface, without "
    "bore; "
    "of Elastosil M4601 (Yeoh, 0.11 and 0.02 MPa), one chamber under pressure; the section of a long one, bending "
    "angle "
    "for 60 mm"
)


def omni(given: Mapping[str, Any], size: float, pressure: float) -> Computed:
    """Bend a three-chamber actuator by a pressure [kPa] in one chamber; dimensions in mm."""
    named = {"chamber_shape"}
    fields = {name: value if name in named else value * mm for name, value in given.items()}
    actuator = tg.actuators.OmnidirectionalActuator(**fields)
    rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    rows = np.arange(0, pressure + STEP / 2, STEP) * kPa
    return bent_section(
        lambda cells: tg.Section(actuator, {"body": rubber}, size=cells),
        size * mm,
        {"cavity_1": rows},
        actuator.length,
        driven="cavity_1",
    )


def area_of(given: Mapping[str, Any]) -> float:
    """Area of one chamber [mm²]."""
    fields = {name: value if name == "chamber_shape" else value * mm for name, value in given.items()}
    actuator = tg.actuators.OmnidirectionalActuator(**fields)
    length = actuator.length - 2 * actuator.cap
    return float(actuator.cavity_volumes["cavity_1"] / length / mm**2)


def angle_at(response: Response, pressure: float) -> Value:
    """Bending angle at a pressure [kPa]."""
    return at(response, "bending_angle", "pressure", pressure * kPa)
