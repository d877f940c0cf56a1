"""Job files: read, run, exported, and solved on several meshes.

The names stand in ``jobs.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
