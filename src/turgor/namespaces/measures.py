"""Measures: numbers of a state, and the tables of contacts and fibers."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.engine.mass import total_mass as total_mass
    from turgor.core.results.fields.contact import ContactResult as ContactResult
    from turgor.core.results.fields.contact import contact_results as contact_results
    from turgor.core.results.fields.fibers import FiberResult as FiberResult
    from turgor.core.results.fields.fibers import fiber_results as fiber_results
    from turgor.core.results.measures.bond_measures import bond_shear_on as bond_shear_on
    from turgor.core.results.measures.bond_measures import opening_of as opening_of
    from turgor.core.results.measures.bond_measures import peel_stress_on as peel_stress_on
    from turgor.core.results.measures.contact_measures import area_on as area_on
    from turgor.core.results.measures.contact_measures import bearing_distance as bearing_distance
    from turgor.core.results.measures.contact_measures import blocked_force as blocked_force
    from turgor.core.results.measures.contact_measures import blocked_force_x as blocked_force_x
    from turgor.core.results.measures.contact_measures import blocked_force_y as blocked_force_y
    from turgor.core.results.measures.contact_measures import blocked_force_z as blocked_force_z
    from turgor.core.results.measures.contact_measures import contact_area as contact_area
    from turgor.core.results.measures.contact_measures import deepest_penetration as deepest_penetration
    from turgor.core.results.measures.contact_measures import force_on as force_on
    from turgor.core.results.measures.contact_measures import grip_force as grip_force
    from turgor.core.results.measures.contact_measures import holding_force as holding_force
    from turgor.core.results.measures.contact_measures import maximum_contact_pressure as maximum_contact_pressure
    from turgor.core.results.measures.contact_measures import moment_on as moment_on
    from turgor.core.results.measures.contact_measures import pull_distance as pull_distance
    from turgor.core.results.measures.fiber_measures import cable_tension as cable_tension
    from turgor.core.results.measures.fiber_measures import cable_travel as cable_travel
    from turgor.core.results.measures.fiber_measures import maximum_fiber_tension as maximum_fiber_tension
    from turgor.core.results.measures.fiber_measures import winding_force_per_length as winding_force_per_length
    from turgor.core.results.measures.field_measures import maximum_principal_stretch as maximum_principal_stretch
    from turgor.core.results.measures.field_measures import maximum_von_mises as maximum_von_mises
    from turgor.core.results.measures.field_measures import principal_stretch_in as principal_stretch_in
    from turgor.core.results.measures.field_measures import principal_stretch_p99 as principal_stretch_p99
    from turgor.core.results.measures.field_measures import von_mises_in as von_mises_in
    from turgor.core.results.measures.field_measures import von_mises_p99 as von_mises_p99
    from turgor.core.results.measures.markers import marker as marker
    from turgor.core.results.measures.measure import Measure as Measure
    from turgor.core.results.measures.measures import bending_angle as bending_angle
    from turgor.core.results.measures.measures import cavity_volume as cavity_volume
    from turgor.core.results.measures.measures import check_measures as check_measures
    from turgor.core.results.measures.measures import reaction as reaction
    from turgor.core.results.measures.measures import smallest_gap as smallest_gap
    from turgor.core.results.measures.measures import tip_displacement as tip_displacement
    from turgor.core.results.measures.measures import tip_displacement_x as tip_displacement_x
    from turgor.core.results.measures.measures import tip_displacement_y as tip_displacement_y
    from turgor.core.results.measures.measures import tip_displacement_z as tip_displacement_z
    from turgor.core.results.measures.measures import twist_angle as twist_angle
    from turgor.core.results.measures.measures import volume_of as volume_of
    from turgor.core.results.measures.point_measures import of_point as of_point
    from turgor.core.results.measures.shape.center_line import CenterLine as CenterLine
    from turgor.core.results.measures.shape.center_line import center_line as center_line
    from turgor.core.results.measures.shape.chords import chord_angle as chord_angle
    from turgor.core.results.measures.shape.rod_strains import middle_curvature_y as middle_curvature_y
    from turgor.core.results.measures.shape.rod_strains import middle_curvature_z as middle_curvature_z
    from turgor.core.results.measures.shape.rod_strains import middle_stretch as middle_stretch
    from turgor.core.results.measures.shape.rod_strains import middle_twist as middle_twist
    from turgor.core.results.measures.shape.rod_strains import rod_strains as rod_strains
    from turgor.core.results.measures.shape.shape_measures import arc_deviation as arc_deviation
    from turgor.core.results.measures.shape.shape_measures import ballooning as ballooning
    from turgor.core.results.measures.shape.shape_measures import bending_plane as bending_plane
    from turgor.core.results.measures.shape.shape_measures import bending_radius as bending_radius
    from turgor.core.results.measures.shape.shape_measures import center_line_length as center_line_length
    from turgor.core.results.measures.shape.shape_measures import curvature as curvature
    from turgor.core.results.measures.shape.shape_measures import helix_pitch as helix_pitch
    from turgor.core.results.measures.shape.shape_measures import helix_radius as helix_radius
    from turgor.core.results.measures.shape.workspaces import Workspace as Workspace
    from turgor.core.results.measures.shape.workspaces import workspace as workspace
    from turgor.core.results.measures.tearing_measures import break_share as break_share
    from turgor.core.results.measures.tearing_measures import cracking_energy_p99 as cracking_energy_p99
    from turgor.core.results.measures.tearing_measures import log_cycles_to_tear as log_cycles_to_tear
    from turgor.core.results.measures.tearing_measures import strength_share as strength_share
    from turgor.core.results.measures.tearing_measures import tearing_energy as tearing_energy
    from turgor.core.results.measures.work.work_measures import efficiency as efficiency
    from turgor.core.results.measures.work.work_measures import fluid_work as fluid_work
    from turgor.core.results.measures.work.work_measures import injected_volume as injected_volume
    from turgor.core.results.measures.work.work_measures import outside_work as outside_work
    from turgor.core.results.measures.work.work_measures import strain_energy as strain_energy
    from turgor.core.results.measures.work.work_measures import tip_stiffness as tip_stiffness
    from turgor.core.results.measures.work.work_measures import tip_stiffness_x as tip_stiffness_x
    from turgor.core.results.measures.work.work_measures import tip_stiffness_y as tip_stiffness_y
    from turgor.core.results.measures.work.work_measures import tip_stiffness_z as tip_stiffness_z
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
