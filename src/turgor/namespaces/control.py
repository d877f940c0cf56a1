"""Control: pressures that make an actuator follow a wanted motion, from a reduced model."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.systems.control.controller import Air as Air
    from turgor.systems.control.controller import Controller as Controller
    from turgor.systems.control.controller import Tuning as Tuning
    from turgor.systems.control.forces import ContactForce as ContactForce
    from turgor.systems.control.limits import Limits as Limits
    from turgor.systems.control.loop import LoopRun as LoopRun
    from turgor.systems.control.loop import Plant as Plant
    from turgor.systems.control.loop import run_loop as run_loop
    from turgor.systems.control.outputs import Angle as Angle
    from turgor.systems.control.outputs import Points as Points
    from turgor.systems.control.outputs import Shape as Shape
    from turgor.systems.control.outputs import Tip as Tip
    from turgor.systems.control.page import write_page as write_page
    from turgor.systems.control.path_file import WantedPath as WantedPath
    from turgor.systems.control.path_file import read_path as read_path
    from turgor.systems.control.track import Track as Track
    from turgor.systems.control.track import track as track
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
