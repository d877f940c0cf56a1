"""Supports: where an actuator is fixed, and where it is moved."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.model.places import NodesAt as NodesAt
    from turgor.core.model.points import Hinge as Hinge
    from turgor.core.model.points import ReferencePoint as ReferencePoint
    from turgor.core.model.points import Rotation as Rotation
    from turgor.core.model.supports import Displacement as Displacement
    from turgor.core.model.supports import Equation as Equation
    from turgor.core.model.supports import Fixed as Fixed
    from turgor.core.model.supports import Foundation as Foundation
    from turgor.core.model.supports import PlaneSection as PlaneSection
    from turgor.core.model.supports import Radial as Radial
    from turgor.core.model.supports import Roller as Roller
    from turgor.core.model.supports import Shift as Shift
    from turgor.core.model.supports import Slide as Slide
    from turgor.core.model.supports import Support as Support
    from turgor.core.model.supports import Symmetry as Symmetry
    from turgor.core.model.supports import Tied as Tied
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
