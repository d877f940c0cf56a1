"""Loads: what drives an actuator."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.materials.alloys.alloy import ShapeMemoryAlloy as ShapeMemoryAlloy
    from turgor.core.model.history import over_time as over_time
    from turgor.core.model.loads import BodyForce as BodyForce
    from turgor.core.model.loads import Centrifugal as Centrifugal
    from turgor.core.model.loads import Channel as Channel
    from turgor.core.model.loads import Force as Force
    from turgor.core.model.loads import Gravity as Gravity
    from turgor.core.model.loads import Hanging as Hanging
    from turgor.core.model.loads import Hardening as Hardening
    from turgor.core.model.loads import HydrostaticPressure as HydrostaticPressure
    from turgor.core.model.loads import LineForce as LineForce
    from turgor.core.model.loads import Load as Load
    from turgor.core.model.loads import Moment as Moment
    from turgor.core.model.loads import Morison as Morison
    from turgor.core.model.loads import PointForce as PointForce
    from turgor.core.model.loads import Pressure as Pressure
    from turgor.core.model.loads import PreStretch as PreStretch
    from turgor.core.model.loads import ShapeMemoryWire as ShapeMemoryWire
    from turgor.core.model.loads import Shrinkage as Shrinkage
    from turgor.core.model.loads import Stiffness as Stiffness
    from turgor.core.model.loads import Swelling as Swelling
    from turgor.core.model.loads import Temperature as Temperature
    from turgor.core.model.loads import Tendon as Tendon
    from turgor.core.model.loads import Traction as Traction
    from turgor.core.model.loads.layer_stack import LayerStack as LayerStack
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
