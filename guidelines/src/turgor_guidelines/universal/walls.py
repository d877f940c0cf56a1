"""Guideline 7.0-1: thinner walls deform more at lower pressure."""

from turgor_guidelines.guideline import Guideline
from turgor_guidelines.single_chamber import thin_walls

#: Families of which the rule speaks too; it was not run with them.
OTHERS = ("bidirectional_bender", "manta_fin", "revolute_joint", "three_extenders")

GUIDELINE = Guideline(
    key="7.0-1",
    rule="Wall thickness has a strong influence on every soft actuator: thinner walls deform more at lower pressure.",
    sources=("Xavier, Fleming and Yong 2021",),
    families=(*thin_walls.GUIDELINE.families, *OTHERS),
    studies=(thin_walls.EXTENDERS, thin_walls.BENDERS),
)
