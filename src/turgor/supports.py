"""Supports: what holds an actuator, and where it is moved."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.model.points import Hinge as Hinge
    from turgor.model.points import ReferencePoint as ReferencePoint
    from turgor.model.points import Rotation as Rotation
    from turgor.model.supports import Displacement as Displacement
    from turgor.model.supports import Fixed as Fixed
    from turgor.model.supports import PlaneSection as PlaneSection
    from turgor.model.supports import Radial as Radial
    from turgor.model.supports import Shift as Shift
    from turgor.model.supports import Symmetry as Symmetry
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
