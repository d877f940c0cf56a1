"""Measures of work: what the fluid does, what is stored, what gets out, and how stiff the tip is."""

from turgor.core.results.measures.work.work_measures import efficiency as efficiency
from turgor.core.results.measures.work.work_measures import fluid_work as fluid_work
from turgor.core.results.measures.work.work_measures import injected_volume as injected_volume
from turgor.core.results.measures.work.work_measures import outside_work as outside_work
from turgor.core.results.measures.work.work_measures import strain_energy as strain_energy
from turgor.core.results.measures.work.work_measures import tip_stiffness as tip_stiffness
from turgor.core.results.measures.work.work_measures import tip_stiffness_x as tip_stiffness_x
from turgor.core.results.measures.work.work_measures import tip_stiffness_y as tip_stiffness_y
from turgor.core.results.measures.work.work_measures import tip_stiffness_z as tip_stiffness_z
