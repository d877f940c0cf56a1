"""Measures of the shape of an actuator: its center line, its angles, and how wide it gets."""

from turgor.core.results.measures.shape.chords import chord_angle as chord_angle
from turgor.core.results.measures.shape.rod_strains import middle_curvature_y as middle_curvature_y
from turgor.core.results.measures.shape.rod_strains import middle_curvature_z as middle_curvature_z
from turgor.core.results.measures.shape.rod_strains import middle_stretch as middle_stretch
from turgor.core.results.measures.shape.rod_strains import middle_twist as middle_twist
from turgor.core.results.measures.shape.shape_measures import arc_deviation as arc_deviation
from turgor.core.results.measures.shape.shape_measures import ballooning as ballooning
from turgor.core.results.measures.shape.shape_measures import bending_plane as bending_plane
from turgor.core.results.measures.shape.shape_measures import bending_radius as bending_radius
from turgor.core.results.measures.shape.shape_measures import center_line_length as center_line_length
from turgor.core.results.measures.shape.shape_measures import curvature as curvature
from turgor.core.results.measures.shape.shape_measures import helix_pitch as helix_pitch
from turgor.core.results.measures.shape.shape_measures import helix_radius as helix_radius
