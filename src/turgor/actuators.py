"""Actuator families: dimensions in, geometry out.

The names stand in ``actuators.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
