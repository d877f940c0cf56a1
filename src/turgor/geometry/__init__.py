"""Geometry: solids with named regions and faces, one actuator family per file."""

from turgor.geometry.actuators.bellows_of_revolution import BellowsOfRevolution
from turgor.geometry.actuators.bidirectional_bender import BidirectionalBender
from turgor.geometry.actuators.bidirectional_pneunet import BidirectionalPneuNet
from turgor.geometry.actuators.contracting_tube import ContractingTube
from turgor.geometry.actuators.eccentric_bender import EccentricBender
from turgor.geometry.actuators.extending_cylinder import ExtendingCylinder
from turgor.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.geometry.actuators.fiber_reinforced_bender import FiberReinforcedBender
from turgor.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.geometry.actuators.free_bottom_pneunet import FreeBottomPneuNet
from turgor.geometry.actuators.helical_pneunet import HelicalPneuNet
from turgor.geometry.actuators.manta_fin import MantaFin
from turgor.geometry.actuators.omnidirectional_actuator import OmnidirectionalActuator
from turgor.geometry.actuators.parallel_bellows import ParallelBellows
from turgor.geometry.actuators.rectangular_bender import RectangularBender
from turgor.geometry.actuators.revolute_joint import RevoluteJoint
from turgor.geometry.actuators.semicircular_bender import SemicircularBender
from turgor.geometry.actuators.slow_pneunet import SlowPneuNet
from turgor.geometry.actuators.three_extenders import ThreeExtenders
from turgor.geometry.actuators.trapezoidal_pneunet import TrapezoidalPneuNet
from turgor.geometry.actuators.triangular_pneunet import TriangularPneuNet
from turgor.geometry.actuators.twisting_tube import TwistingTube
from turgor.geometry.actuators.two_material_bender import TwoMaterialBender
from turgor.geometry.geometry import Geometry

__all__ = [
    "BellowsOfRevolution",
    "BidirectionalBender",
    "BidirectionalPneuNet",
    "ContractingTube",
    "EccentricBender",
    "ExtendingCylinder",
    "FastPneuNet",
    "FiberReinforcedBender",
    "FiberReinforcedCylinder",
    "FreeBottomPneuNet",
    "Geometry",
    "HelicalPneuNet",
    "MantaFin",
    "OmnidirectionalActuator",
    "ParallelBellows",
    "RectangularBender",
    "RevoluteJoint",
    "SemicircularBender",
    "SlowPneuNet",
    "ThreeExtenders",
    "TrapezoidalPneuNet",
    "TriangularPneuNet",
    "TwistingTube",
    "TwoMaterialBender",
]
