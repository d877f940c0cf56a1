"""Guideline 7.0-5, the summary of section 7 on chambers: the studies of 7.4-2, 7.4-5 and 7.4-6 judge it."""

from turgor_guidelines.guideline import Guideline
from turgor_guidelines.multi_chamber import more_chambers, slow_and_fast, thick_walls

GUIDELINE = Guideline(
    key="7.0-5",
    rule="For multi-chambered actuators, thinner internal walls, more chambers and the corrugated design of fast "
    "PneuNets improve the stroke.",
    sources=("Xavier, Fleming and Yong 2021",),
    families=("fast_pneunet", "slow_pneunet"),
    studies=(
        *thick_walls.GUIDELINE.studies,
        *more_chambers.GUIDELINE.studies,
        slow_and_fast.GUIDELINE.studies[0],
    ),
)
