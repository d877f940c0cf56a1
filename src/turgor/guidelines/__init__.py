"""Guidelines: the design rules of the review by Xavier, Fleming and Yong (2021), each run and judged.

Every module of the folders below holds one rule as a `Guideline`: what is claimed, what is computed to test it, and how
the numbers are judged. The studies are written as a user would write them, with the public names only.
"""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.guidelines.catalog import chosen as chosen
    from turgor.guidelines.guideline import Guideline as Guideline
    from turgor.guidelines.guideline import GuidelineTest as GuidelineTest
    from turgor.guidelines.guideline import Judgement as Judgement
    from turgor.guidelines.guideline import Verdict as Verdict
    from turgor.guidelines.judge import judged as judged
    from turgor.guidelines.judge import run_guidelines as run_guidelines
    from turgor.guidelines.page import write_markdown as write_markdown
    from turgor.guidelines.page import write_page as write_page
    from turgor.views.plots.study_figure import Line as Line
    from turgor.views.plots.study_figure import Panel as Panel
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
