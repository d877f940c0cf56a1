"""Supports of an actuator, a file for each. Those of reference points are in `turgor.core.model.points`."""

from turgor.core.model.places import NodesAt as NodesAt
from turgor.core.model.supports.displacement import Displacement as Displacement
from turgor.core.model.supports.displacement import Shift as Shift
from turgor.core.model.supports.equation import Equation as Equation
from turgor.core.model.supports.fixed import Fixed as Fixed
from turgor.core.model.supports.foundation import Foundation as Foundation
from turgor.core.model.supports.plane_section import PlaneSection as PlaneSection
from turgor.core.model.supports.radial import Radial as Radial
from turgor.core.model.supports.roller import Roller as Roller
from turgor.core.model.supports.slide import Slide as Slide
from turgor.core.model.supports.support import Support as Support
from turgor.core.model.supports.symmetry import Symmetry as Symmetry
from turgor.core.model.supports.tied import Tied as Tied
