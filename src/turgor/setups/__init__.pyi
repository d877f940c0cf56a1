"""Setups: functions that make the model of an experiment from that of an actuator."""

from turgor.setups.blocked_tip import blocked_force as blocked_force
from turgor.setups.grasped_object import grasp as grasp
