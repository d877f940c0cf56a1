"""Sections: what a long actuator does far from its ends, and outlines to sketch a cross-section."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.geometry.shapes.sections import Outline as Outline
    from turgor.geometry.shapes.sections import disc as disc
    from turgor.geometry.shapes.sections import half_disc as half_disc
    from turgor.geometry.shapes.sections import polygon as polygon
    from turgor.geometry.shapes.sections import rectangle as rectangle
    from turgor.geometry.shapes.sections import ring_sector as ring_sector
    from turgor.section.rod_section import rod_section as rod_section
    from turgor.section.section import Section as Section
    from turgor.section.shapes.cut import cut as cut
    from turgor.section.shapes.sketch import Sketch as Sketch
    from turgor.section.solution import SectionError as SectionError
    from turgor.section.solution import SectionSolution as SectionSolution
    from turgor.section.stiffness import SectionStiffness as SectionStiffness
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
