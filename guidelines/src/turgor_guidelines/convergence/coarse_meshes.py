"""Claim 8.1-3: a coarse mesh may underestimate the deformation; the study is that of claim 6.2-1."""

from turgor_guidelines.convergence.coarse_mesh import STUDY
from turgor_guidelines.guideline import Guideline

GUIDELINE = Guideline(
    key="8.1-3",
    rule="A coarse mesh may underestimate the actuator's deformation.",
    sources=("Xavier et al. 2021",),
    families=("fiber_reinforced_bender",),
    studies=(STUDY,),
)
