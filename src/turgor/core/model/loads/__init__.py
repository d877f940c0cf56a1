"""Loads: what drives the actuator, a file for each.

A load grows in proportion to the load factor, unless it has a history. `turgor.core.model.loads.load` says what follows
from a load.
"""

from turgor.core.model.loads.body_force import BodyForce as BodyForce
from turgor.core.model.loads.centrifugal import Centrifugal as Centrifugal
from turgor.core.model.loads.channel import Channel as Channel
from turgor.core.model.loads.force import Force as Force
from turgor.core.model.loads.gravity import STANDARD_GRAVITY as STANDARD_GRAVITY
from turgor.core.model.loads.gravity import Gravity as Gravity
from turgor.core.model.loads.hanging import Hanging as Hanging
from turgor.core.model.loads.hardening import Hardening as Hardening
from turgor.core.model.loads.hydrostatic_pressure import HydrostaticPressure as HydrostaticPressure
from turgor.core.model.loads.line_force import LineForce as LineForce
from turgor.core.model.loads.load import Load as Load
from turgor.core.model.loads.moment import Moment as Moment
from turgor.core.model.loads.morison import Morison as Morison
from turgor.core.model.loads.point_force import PointForce as PointForce
from turgor.core.model.loads.pre_stretch import PreStretch as PreStretch
from turgor.core.model.loads.pressure import Pressure as Pressure
from turgor.core.model.loads.pressure import pressures_among as pressures_among
from turgor.core.model.loads.shape_memory_wire import ShapeMemoryWire as ShapeMemoryWire
from turgor.core.model.loads.shrinkage import Shrinkage as Shrinkage
from turgor.core.model.loads.stiffness import Stiffness as Stiffness
from turgor.core.model.loads.swelling import Swelling as Swelling
from turgor.core.model.loads.temperature import Temperature as Temperature
from turgor.core.model.loads.tendon import Tendon as Tendon
from turgor.core.model.loads.traction import Traction as Traction
