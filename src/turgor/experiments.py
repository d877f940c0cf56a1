"""Experiments on materials: tests read and prepared, laws fitted to them and ranked.

The names stand in ``experiments.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
