"""Bodies beside the actuator: simple solids, and meshes placed, mirrored and put together.

The names stand in ``bodies.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
