"""Settings of gradients: every number that was chosen, with its reason.

`tests/unit/accuracy/gradients` and `tests/verification/gradients` need them.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class GradientSettings:
    """Settings of derivatives along a state.

    Parameters
    ----------
    step : float
        Step of differences as a share of the value, and longest motion of an unknown along the rates, in mean edge
        lengths and shear moduli. The error of a central difference is about its square; round-off, 1e-15 of the
        forces, is divided by it.
    accurate : float
        Relative residual that a solve leaves: of the state, where round-off or contact lets it fall no further, and of
        the rates, whose corrections would bring round-off into them.
    good_enough : float
        Share of the forces ∂R/∂p that may be left of rates that corrections do not improve.
    consistent : float
        Difference of tangent and residuals along an adjoint up to which it is taken. Differences of residuals are
        themselves right to a few 1e-6 (1.2e-6 for a finger of 31,443 unknowns); beyond, something switches at the
        state.
    corrections, contraction : int, float
        Most corrections of a solution; each must reduce what is left to this share.
    refined : float
        Relative update that is left where the refinement of a solution of linear equations ends.
    few_updates : int
        Updates of the state up to which the factors of its beginning are reused: more of them move it farther.
    kink : float
        Nodes move another way on the other side where the second difference of their positions is this share of the
        first: a layer of cells moves at once where a wall gets thicker than a gap.
    """

    step: float = 1e-4
    accurate: float = 1e-6
    good_enough: float = 1e-4
    consistent: float = 5e-6
    corrections: int = 8
    contraction: float = 0.5
    refined: float = 1e-11
    few_updates: int = 2
    kink: float = 1e-2


GRADIENTS = GradientSettings()
