"""Actuator families: dimensions in, geometry out."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.geometry.actuators.bellows_of_revolution import BellowsOfRevolution as BellowsOfRevolution
    from turgor.core.geometry.actuators.bidirectional_bender import BidirectionalBender as BidirectionalBender
    from turgor.core.geometry.actuators.bidirectional_pneunet import BidirectionalPneuNet as BidirectionalPneuNet
    from turgor.core.geometry.actuators.buckling_muscle import BucklingMuscle as BucklingMuscle
    from turgor.core.geometry.actuators.contracting_tube import ContractingTube as ContractingTube
    from turgor.core.geometry.actuators.eccentric_bender import EccentricBender as EccentricBender
    from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder as ExtendingCylinder
    from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet as FastPneuNet
    from turgor.core.geometry.actuators.fiber_reinforced_bender import FiberReinforcedBender as FiberReinforcedBender
    from turgor.core.geometry.actuators.fiber_reinforced_cylinder import (
        FiberReinforcedCylinder as FiberReinforcedCylinder,
    )
    from turgor.core.geometry.actuators.free_bottom_pneunet import FreeBottomPneuNet as FreeBottomPneuNet
    from turgor.core.geometry.actuators.helical_pneunet import HelicalPneuNet as HelicalPneuNet
    from turgor.core.geometry.actuators.inflatable_beam import InflatableBeam as InflatableBeam
    from turgor.core.geometry.actuators.kresling_tube import KreslingTube as KreslingTube
    from turgor.core.geometry.actuators.manta_fin import MantaFin as MantaFin
    from turgor.core.geometry.actuators.miura_tube import MiuraTube as MiuraTube
    from turgor.core.geometry.actuators.omnidirectional_actuator import (
        OmnidirectionalActuator as OmnidirectionalActuator,
    )
    from turgor.core.geometry.actuators.parallel_bellows import ParallelBellows as ParallelBellows
    from turgor.core.geometry.actuators.pouch import Pouch as Pouch
    from turgor.core.geometry.actuators.rectangular_bender import RectangularBender as RectangularBender
    from turgor.core.geometry.actuators.revolute_joint import RevoluteJoint as RevoluteJoint
    from turgor.core.geometry.actuators.semicircular_bender import SemicircularBender as SemicircularBender
    from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet as SlowPneuNet
    from turgor.core.geometry.actuators.three_extenders import ThreeExtenders as ThreeExtenders
    from turgor.core.geometry.actuators.trapezoidal_pneunet import TrapezoidalPneuNet as TrapezoidalPneuNet
    from turgor.core.geometry.actuators.triangular_pneunet import TriangularPneuNet as TriangularPneuNet
    from turgor.core.geometry.actuators.twisting_tube import TwistingTube as TwistingTube
    from turgor.core.geometry.actuators.two_material_bender import TwoMaterialBender as TwoMaterialBender
    from turgor.core.geometry.actuators.yoshimura_bellows import YoshimuraBellows as YoshimuraBellows
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
