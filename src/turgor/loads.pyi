"""Loads: what drives an actuator."""

from turgor.model.history import over_time as over_time
from turgor.model.loads import BodyForce as BodyForce
from turgor.model.loads import Gravity as Gravity
from turgor.model.loads import Pressure as Pressure
from turgor.model.loads import Traction as Traction
