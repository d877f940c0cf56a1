"""Guidelines: the design rules of the review by Xavier, Fleming and Yong (2021), each run and judged.

Every module below holds one rule as a `Guideline`: what is claimed, what is computed to test it, and how the numbers
are judged. The studies are written as a user would write them, with the public names only.
"""
