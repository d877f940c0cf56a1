"""What a solution holds: states, limit points, first touches, energies, modes and findings.

The names stand in ``solutions.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
