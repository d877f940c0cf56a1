"""Actuators of the guidelines on modeling: a fiber-reinforced bender as a section, tubes by formula."""

from collections.abc import Sequence

import numpy as np

import turgor as tg
from turgor.studies import Computed
from turgor.units import deg, kPa, mm
from turgor_guidelines.bent_sections import bent_section
from turgor_guidelines.values import Value

#: Length of the bender [mm].
LENGTH = 160

BENDER = (
    "Section of a semicircular bender: void of radius 8 mm, wall and base of 2 mm, Kevlar hoops every 3 mm around "
    "all of "
    "it and a fabric of 650 N/mm on the flat side; bending angle of 160 mm"
)
TUBE = "Long tube, inner radius 6.35 mm, wall 2 mm, closed ends, by formula"


def rubber_of(named: str) -> tg.Material:
    """Material of the library from ``"name/record"``."""
    name, record = named.split("/")
    return tg.from_library(name, record=record)


def threads(
    face: str | tuple[str, ...], angle: float, spacing: float, compression: float, *, thinner: float = 1.0
) -> tg.Fibers:
    """Kevlar threads of 0.1778 mm at an angle from the axis [deg], every so many mm.

    ``compression`` is the share of the stiffness that works in compression; ``thinner`` multiplies the diameter.
    """
    winding = tg.Winding(angle_from_axis=angle * deg, spacing=spacing * mm)
    return tg.Fibers(
        face=face,
        material=tg.from_library("kevlar-fiber"),
        diameter=thinner * 0.1778 * mm,
        winding=winding,
        compression=compression,
    )


def bender(
    rubber: str,
    pressure: float,
    size: float,
    hoops: bool = True,
    compression: Sequence[float] = (1.0, 1.0),
    thinner: float = 1.0,
) -> Computed:
    """Bend the section of a bender by a pressure [kPa], cells of a size [mm].

    ``compression`` is that of the hoops and of the fabric; ``thinner`` multiplies the diameter of the hoops.
    """
    finger = tg.actuators.FiberReinforcedBender(radius=8 * mm, wall=2 * mm, base=2 * mm, skin=0.0, length=LENGTH * mm)
    flat = "strain_limiting_layer"
    fibers = [threads(flat, angle, 1.187, compression[1]) for angle in (0, 90)]
    if hoops:
        fibers.append(threads(("outside", flat), 90, 3, compression[0], thinner=thinner))
    material = rubber_of(rubber)
    return bent_section(
        lambda cells: tg.Section(finger, {"body": material}, reinforcements=fibers, size=cells),
        size * mm,
        np.linspace(0, pressure, 11) * kPa,
        LENGTH * mm,
    )


def tube(rubber: str, stretch: float, hoops: bool) -> Computed:
    """Inflate a tube until its inner wall (free) or its length (hoops) has a stretch; pressure against it."""
    actuator = tg.actuators.ExtendingCylinder()
    material = rubber_of(rubber)
    stretches = np.linspace(1, stretch, 41)[1:]
    if not hoops:
        result = tg.formulas.thick_tube(actuator, material, inner_stretch=stretches)
        return Computed(response=pressures_of(result["pressure"], result["inner_stretch"], result.source))
    wound = threads("outside", 90, 0.2, 1.0)
    result = tg.formulas.wound_tube(
        actuator, material, wound, np.linspace(0, stretch_pressure(material, stretch), 41)[1:]
    )
    return Computed(response=pressures_of(result["pressure"], result["axial_stretch"], result.source))


def stretch_pressure(material: tg.Material, stretch: float) -> float:
    """Pressure [Pa] that is enough to stretch a wound tube so far: four times its modulus times the strain."""
    return 4 * material.law.shear_modulus * (stretch - 1)


def pressures_of(pressure: np.ndarray, stretch: np.ndarray, source: tg.laws.Source) -> tg.Response:
    """Response of pressure against stretch, from rest."""
    return tg.Response(
        columns=(
            tg.experiments.Column("pressure", "kPa", np.concatenate([[0.0], pressure])),
            tg.experiments.Column("stretch", "", np.concatenate([[1.0], stretch])),
        ),
        source=source,
    )


def apart(a: Value, b: Value) -> float:
    """Relative difference of two values to the second one."""
    return abs(a.number / b.number - 1)
