"""Loads: what drives an actuator.

The names stand in ``loads.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
