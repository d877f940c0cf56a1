"""Bodies wound with fibers: hoops that hold a radius, hoops and helices that are smeared over a face."""

from dataclasses import replace

import turgor as tg
from benchmarks.truth.truth_cases.case import Case
from turgor.units import MPa, deg, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12 * MPa))
KEVLAR = tg.from_library("kevlar-fiber")
THREAD = 0.1778 * mm
HOOPS = tg.Winding(angle_from_axis=90 * deg, spacing=2 * mm)
LENGTHWISE = tg.Winding(angle_from_axis=0.0, spacing=2 * mm)
HELIX = tg.Winding(angle_from_axis=60 * deg, spacing=2 * mm, hand="right")
DOUBLE = tg.Winding(angle_from_axis=70 * deg, spacing=2 * mm, hand="both")
#: Threads that also take compression: where hoops of a bender go slack, thousands of them change sides at every step.
ROD = tg.Fibers(face="winding", material=KEVLAR, diameter=THREAD, winding=HOOPS, compression=1.0)
WALLED = {"body": RUBBER, "skin": RUBBER}
SKINNED = tg.actuators.FiberReinforcedCylinder(length=40 * mm, skin=1 * mm)

CASES = (
    Case(
        name="held_cylinder",
        title="Cylinder with a skin of 1 mm, its winding fixed radially, 13.72 kPa",
        actuator=SKINNED,
        materials=WALLED,
        pressures={"cavity": 13.7201},
        measures=(tg.measures.tip_displacement_x, tg.cavity_volume),
        supports=(tg.Fixed("fixed", "x"), tg.supports.Radial("winding")),
        third_order_size=2.0,
        bisections=(),
        jumps=True,
    ),
    Case(
        name="wound_cylinder",
        title="Cylinder with a skin of 1 mm, Kevlar at 70° from the axis, both hands, 40 kPa",
        actuator=SKINNED,
        materials=WALLED,
        pressures={"cavity": 40.0},
        measures=(tg.measures.tip_displacement_x, tg.cavity_volume),
        reinforcements=(tg.Fibers(face="winding", material=KEVLAR, diameter=THREAD, winding=DOUBLE),),
        third_order_size=2.0,
        bisections=(),
        jumps=True,
    ),
    Case(
        name="wound_bender",
        title="Half-round bender with a skin of 1 mm, Kevlar hoops, Kevlar along the base, none slack, 20 kPa",
        actuator=tg.actuators.FiberReinforcedBender(length=50 * mm),
        materials=WALLED,
        pressures={"cavity": 20.0},
        measures=(tg.bending_angle, tg.tip_displacement, tg.cavity_volume),
        reinforcements=(
            replace(ROD, face=("winding", "strain_limiting_layer"), winding=HOOPS),
            replace(ROD, face="strain_limiting_layer", winding=LENGTHWISE),
        ),
        third_order_size=5.0,
        layers=1,
        confirmed="double",
        bisections=(),
    ),
    Case(
        name="twisting_tube",
        title="Tube with a helix of Kevlar of one hand, 60° from the axis, 20 kPa",
        actuator=tg.actuators.TwistingTube(length=40 * mm),
        materials={"body": RUBBER},
        pressures={"cavity": 20.0},
        measures=(tg.measures.twist_angle, tg.measures.tip_displacement_x, tg.cavity_volume),
        reinforcements=(tg.Fibers(face="outside", material=KEVLAR, diameter=THREAD, winding=HELIX),),
        third_order_size=6.0,
        bisections=(),
    ),
)
