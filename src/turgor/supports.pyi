"""Supports: what holds an actuator, and where it is moved."""

from turgor.model.supports import Displacement as Displacement
from turgor.model.supports import Fixed as Fixed
from turgor.model.supports import Radial as Radial
from turgor.model.supports import Shift as Shift
from turgor.model.supports import Symmetry as Symmetry
