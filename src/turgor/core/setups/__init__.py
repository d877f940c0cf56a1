"""Setups: functions that make the model of an experiment from that of an actuator."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.setups.blocked_tip import blocked_force as blocked_force
    from turgor.core.setups.grasped_object import grasp as grasp
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
