"""Meshes and models from and for other programs.

The names stand in ``files.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
