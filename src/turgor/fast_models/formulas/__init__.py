"""Formulas: analytic models of actuators, each with its assumptions, that end in a `Response` like finite elements."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.fast_models.formulas.arcs import Arc as Arc
    from turgor.fast_models.formulas.arcs import arc_to as arc_to
    from turgor.fast_models.formulas.arcs import backbone as backbone
    from turgor.fast_models.formulas.arcs import pose as pose
    from turgor.fast_models.formulas.arcs import poses as poses
    from turgor.fast_models.formulas.arcs_inverse import Reach as Reach
    from turgor.fast_models.formulas.arcs_inverse import reach as reach
    from turgor.fast_models.formulas.bellows import castigliano_bellows as castigliano_bellows
    from turgor.fast_models.formulas.bender_arcs import arc_of_lengths as arc_of_lengths
    from turgor.fast_models.formulas.bender_arcs import constant_curvature as constant_curvature
    from turgor.fast_models.formulas.bender_arcs import lengths_of_arc as lengths_of_arc
    from turgor.fast_models.formulas.bending_beam import euler_bernoulli as euler_bernoulli
    from turgor.fast_models.formulas.braided_muscle import ideal_mckibben as ideal_mckibben
    from turgor.fast_models.formulas.braided_muscle import mckibben as mckibben
    from turgor.fast_models.formulas.catalog import about as about
    from turgor.fast_models.formulas.catalog import formulas_for as formulas_for
    from turgor.fast_models.formulas.fiber_reinforced import fiber_reinforced_bender as fiber_reinforced_bender
    from turgor.fast_models.formulas.formula import Formula as Formula
    from turgor.fast_models.formulas.lumped import SecondOrder as SecondOrder
    from turgor.fast_models.formulas.lumped import identify_step as identify_step
    from turgor.fast_models.formulas.lumped import identify_sweep as identify_sweep
    from turgor.fast_models.formulas.thick_walled import HollowSphere as HollowSphere
    from turgor.fast_models.formulas.thick_walled import Turn as Turn
    from turgor.fast_models.formulas.thick_walled import limit_points as limit_points
    from turgor.fast_models.formulas.thick_walled import thick_sphere as thick_sphere
    from turgor.fast_models.formulas.thick_walled import thick_tube as thick_tube
    from turgor.fast_models.formulas.wound_tubes import wound_tube as wound_tube
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
