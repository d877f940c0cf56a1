"""Supports: what holds an actuator, and where it is moved.

The names stand in ``supports.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
