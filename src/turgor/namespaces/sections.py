"""Sections: what a long actuator does far from its ends, and outlines to sketch a cross-section."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.geometry.shapes.sections import Outline as Outline
    from turgor.core.geometry.shapes.sections import disc as disc
    from turgor.core.geometry.shapes.sections import half_disc as half_disc
    from turgor.core.geometry.shapes.sections import polygon as polygon
    from turgor.core.geometry.shapes.sections import rectangle as rectangle
    from turgor.core.geometry.shapes.sections import ring_sector as ring_sector
    from turgor.fast_models.section.rod_section import rod_section as rod_section
    from turgor.fast_models.section.section import Section as Section
    from turgor.fast_models.section.shapes.cut import cut as cut
    from turgor.fast_models.section.shapes.sketch import Sketch as Sketch
    from turgor.fast_models.section.solution import SectionError as SectionError
    from turgor.fast_models.section.solution import SectionSolution as SectionSolution
    from turgor.fast_models.section.stiffness import SectionStiffness as SectionStiffness
    from turgor.views.plots.section import plot_section as plot_section
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
