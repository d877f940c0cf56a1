"""Thin curved walls without fibers: tubes, cylinders of several chambers, bellows, a joint."""

import turgor as tg
from benchmarks.truth.truth_cases.case import Case
from turgor.units import MPa, mm

ELASTOSIL = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
DRAGON = tg.from_library("dragon-skin-30", record="yeoh-yang-2020")
ECOFLEX = tg.from_library("ecoflex-00-30", record="yeoh-steck-2019")
PLASTIC = tg.Material(name="stiff plastic", law=tg.laws.NeoHooke(C10=50 * MPa))
FLEXIBLE = tg.Material(name="flexible plastic", law=tg.laws.NeoHooke(C10=2 * MPa))
#: A plate 0.5 mm above the tube; its image in the mirror plane is below.
PLATE = tg.obstacles.Obstacle(name="plate", shape=tg.obstacles.Plane(point=(0, 0, 8.85 * mm), normal=(0, 0, -1)))

CASES = (
    Case(
        name="closed_tube",
        title="Closed tube (extending cylinder, a quarter), 30 kPa",
        actuator=tg.actuators.ExtendingCylinder(length=40 * mm),
        materials={"body": ELASTOSIL},
        pressures={"cavity": 30.0},
        measures=(tg.measures.tip_displacement_x, tg.cavity_volume),
        third_order_size=3.0,
        bisections=(),
    ),
    Case(
        name="tube_between_plates",
        title="Closed tube between two rigid plates, 0.5 mm from each, 50 kPa",
        actuator=tg.actuators.ExtendingCylinder(length=40 * mm),
        materials={"body": ELASTOSIL},
        pressures={"cavity": 50.0},
        measures=(tg.cavity_volume, tg.measures.tip_displacement_x),
        contact=tg.Contact(self_contact=False, obstacles=[PLATE], tolerance=1e-3),
        third_order_size=0.0,
        first="hexahedra",
    ),
    Case(
        name="omnidirectional_circles",
        title="Omnidirectional actuator with round chambers, one of three at 12 kPa",
        actuator=tg.actuators.OmnidirectionalActuator(length=40 * mm, symmetric=True),
        materials={"body": ECOFLEX},
        pressures={"cavity_1": 12.0},
        measures=(tg.bending_angle, tg.tip_displacement, tg.cavity_volume),
        third_order_size=5.0,
        graded=(2.0, 0.2),
        bisections=(0.1, 0.05),
    ),
    Case(
        name="omnidirectional_sectors",
        title="Omnidirectional actuator with chambers like sectors of a ring, one of three at 7 kPa",
        actuator=tg.actuators.OmnidirectionalActuator(
            length=40 * mm, chamber_shape="ring_sector", chamber_size=5 * mm, symmetric=True
        ),
        materials={"body": ECOFLEX},
        pressures={"cavity_1": 7.0},
        measures=(tg.bending_angle, tg.tip_displacement, tg.cavity_volume),
        third_order_size=4.0,
        graded=(1.5, 0.4),
    ),
    Case(
        name="bellows",
        title="Bellows of revolution, two rounded folds, 5 kPa",
        actuator=tg.actuators.BellowsOfRevolution(folds=2),
        materials={"body": DRAGON},
        pressures={"cavity": 5.0},
        measures=(tg.measures.tip_displacement_x, tg.cavity_volume),
        third_order_size=3.0,
        bisections=(),
    ),
    Case(
        name="revolute_joint",
        title="Revolute joint with one cylinder, links 3000 times as stiff, 5 kPa",
        actuator=tg.actuators.RevoluteJoint(actuators=1, length=40 * mm),
        materials={"body": ECOFLEX, "link": PLASTIC, "hinge": FLEXIBLE},
        pressures={"cavity": 5.0},
        measures=(tg.bending_angle, tg.tip_displacement, tg.cavity_volume),
        third_order_size=3.0,
        graded=(3.0, 0.3),
        bisections=(0.15, 0.05),
        jumps=True,
    ),
)
