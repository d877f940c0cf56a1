"""Laws of materials: strain energies, viscoelasticity and softening, their curves, and the library of records.

The names stand in ``laws.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
