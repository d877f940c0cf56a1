"""CAD files: read, looked through and named; written as STEP, and the mold to cast an actuator in.

The names stand in ``cad.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
