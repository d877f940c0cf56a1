"""PneuNets and a bender of two rubbers: short ones, so that fine meshes are affordable."""

import turgor as tg
from benchmarks.truth.truth_cases.case import Case
from turgor.units import MPa, mm

ELASTOSIL = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
STIFF = tg.Material(name="stiff rubber", law=tg.laws.NeoHooke(C10=2.2 * MPa))
PAPER = tg.from_library("paper", record="hooke-polygerinos-2020")
FAST = tg.FastPneuNet(chambers=3, length=30 * mm)
ON_PAPER = {"body": ELASTOSIL, "base": ELASTOSIL, "strain_limiting_layer": tg.Shell(PAPER, thickness=0.1 * mm)}
ON_MEMBRANE = ON_PAPER | {"strain_limiting_layer": tg.Membrane(PAPER, thickness=0.1 * mm)}
ON_STIFF = {"body": ELASTOSIL, "base": STIFF}

CASES = (
    Case(
        name="fast_pneunet_paper",
        title="Fast PneuNet of three chambers, paper of 0.1 mm as a membrane, 6 kPa",
        actuator=FAST,
        materials=ON_MEMBRANE,  # the independent code has no shells
        pressures={"cavity": 6.0},
        measures=(tg.bending_angle, tg.tip_displacement, tg.cavity_volume),
        third_order_size=3.5,
    ),
    Case(
        name="fast_pneunet_stiff_base",
        title="Fast PneuNet of three chambers, base 20 times as stiff, 4 kPa",
        actuator=FAST,
        materials=ON_STIFF,
        pressures={"cavity": 4.0},
        measures=(tg.bending_angle, tg.tip_displacement, tg.cavity_volume),
        third_order_size=2.2,
        bisections=(0.2,),
        graded=(4.0, 0.2),
        first="hexahedra",
        jumps=True,
    ),
    Case(
        name="slow_pneunet",
        title="Slow PneuNet of three chambers, base 20 times as stiff, 10 kPa",
        actuator=tg.actuators.SlowPneuNet(chambers=3, length=30 * mm),
        materials=ON_STIFF,
        pressures={"cavity": 10.0},
        measures=(tg.bending_angle, tg.tip_displacement, tg.cavity_volume),
        third_order_size=4.0,
        layers=1,
        bisections=(),
        graded=(4.0, 0.2),
        first="hexahedra",
        jumps=True,
    ),
    Case(
        name="semicircular_bender",
        title="Half-round bender of two rubbers (the reference bender, 50 mm long), 20 kPa",
        actuator=tg.actuators.SemicircularBender(length=50 * mm, floor=1 * mm, base=1 * mm, end_wall=3 * mm),
        materials=ON_STIFF,
        pressures={"cavity": 20.0},
        measures=(tg.bending_angle, tg.tip_displacement, tg.cavity_volume),
        third_order_size=2.6,
        layers=1,
        layered_rims=True,
        bisections=(),
        graded=(1.2, 0.4),
        jumps=True,
    ),
    Case(
        name="fast_pneunet_contact",
        title="Fast PneuNet of three chambers, paper, pressed until its walls touch, 16 kPa",
        actuator=FAST,
        materials=ON_PAPER,
        pressures={"cavity": 16.0},
        measures=(tg.bending_angle, tg.cavity_volume),
        third_order_size=0.0,
        first="mean",
        contact=tg.Contact(),
    ),
)
