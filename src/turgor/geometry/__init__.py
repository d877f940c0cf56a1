"""Geometry: solids with named regions and faces, one actuator family per file.

Names are imported on first use, because every room imports from a file of this one, and few need the CAD kernel.
"""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.geometry.actuators.bellows_of_revolution import BellowsOfRevolution as BellowsOfRevolution
    from turgor.geometry.actuators.bidirectional_bender import BidirectionalBender as BidirectionalBender
    from turgor.geometry.actuators.bidirectional_pneunet import BidirectionalPneuNet as BidirectionalPneuNet
    from turgor.geometry.actuators.contracting_tube import ContractingTube as ContractingTube
    from turgor.geometry.actuators.eccentric_bender import EccentricBender as EccentricBender
    from turgor.geometry.actuators.extending_cylinder import ExtendingCylinder as ExtendingCylinder
    from turgor.geometry.actuators.fast_pneunet import FastPneuNet as FastPneuNet
    from turgor.geometry.actuators.fiber_reinforced_bender import FiberReinforcedBender as FiberReinforcedBender
    from turgor.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder as FiberReinforcedCylinder
    from turgor.geometry.actuators.free_bottom_pneunet import FreeBottomPneuNet as FreeBottomPneuNet
    from turgor.geometry.actuators.helical_pneunet import HelicalPneuNet as HelicalPneuNet
    from turgor.geometry.actuators.manta_fin import MantaFin as MantaFin
    from turgor.geometry.actuators.omnidirectional_actuator import OmnidirectionalActuator as OmnidirectionalActuator
    from turgor.geometry.actuators.parallel_bellows import ParallelBellows as ParallelBellows
    from turgor.geometry.actuators.rectangular_bender import RectangularBender as RectangularBender
    from turgor.geometry.actuators.revolute_joint import RevoluteJoint as RevoluteJoint
    from turgor.geometry.actuators.semicircular_bender import SemicircularBender as SemicircularBender
    from turgor.geometry.actuators.slow_pneunet import SlowPneuNet as SlowPneuNet
    from turgor.geometry.actuators.three_extenders import ThreeExtenders as ThreeExtenders
    from turgor.geometry.actuators.trapezoidal_pneunet import TrapezoidalPneuNet as TrapezoidalPneuNet
    from turgor.geometry.actuators.triangular_pneunet import TriangularPneuNet as TriangularPneuNet
    from turgor.geometry.actuators.twisting_tube import TwistingTube as TwistingTube
    from turgor.geometry.actuators.two_material_bender import TwoMaterialBender as TwoMaterialBender
    from turgor.geometry.geometry import Geometry as Geometry

if not TYPE_CHECKING:
    __getattr__, __dir__, __all__ = public(__file__, globals())
