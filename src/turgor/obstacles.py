"""Obstacles: rigid shapes that an actuator touches.

The names stand in ``obstacles.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
