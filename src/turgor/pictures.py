"""Pictures and plots of meshes, states and responses.

The names stand in ``pictures.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
