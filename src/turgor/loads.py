"""Loads: what drives an actuator."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.model.history import over_time as over_time
    from turgor.model.loads import BodyForce as BodyForce
    from turgor.model.loads import Force as Force
    from turgor.model.loads import Gravity as Gravity
    from turgor.model.loads import Hanging as Hanging
    from turgor.model.loads import LineForce as LineForce
    from turgor.model.loads import Moment as Moment
    from turgor.model.loads import PointForce as PointForce
    from turgor.model.loads import Pressure as Pressure
    from turgor.model.loads import Traction as Traction
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
