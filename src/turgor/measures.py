"""Measures: numbers of a state, and the tables of contacts and fibers.

The names stand in ``measures.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
