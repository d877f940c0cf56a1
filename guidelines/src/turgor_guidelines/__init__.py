"""Guidelines: the design rules of the review by Xavier, Fleming and Yong (2021), each run and judged.

Every module of the folders below holds one rule as a `turgor_guidelines.guideline.Guideline`: what is claimed, what is
computed to test it, and how the numbers are judged. The studies are written as a user of turgor would write them, with
its public names only. `turgor_guidelines.judge` runs and judges them, `turgor_guidelines.page` writes the page,
`turgor_guidelines.command` is the command ``turgor guidelines``.
"""
