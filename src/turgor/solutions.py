"""What a solution holds: limit points, first touches, energies and modes.

The names stand in ``solutions.pyi``; each is imported on first use.
"""

from turgor._lazy import public

__getattr__, __dir__, __all__ = public(__file__, globals())
