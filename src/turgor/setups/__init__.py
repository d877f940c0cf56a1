"""Setups: functions that make the model of an experiment from that of an actuator.

The names stand in ``__init__.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
