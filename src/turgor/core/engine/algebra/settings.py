"""Settings of the linear solvers: every number that was chosen, with its reason.

All are without unit. Most decide about speed only; `benchmarks/core/iterative.py` and `benchmarks/core/newton.py`
measure it. What decides about results is tested in `tests/unit/core/engine/test_linear_solvers.py` and
`test_iterative.py`.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LinearSolverSettings:
    """Settings of direct solvers.

    Parameters
    ----------
    small : int
        Below so many unknowns factors are in double precision: there is nothing to gain.
    dissected_from : int
        From so many unknowns on nested dissection orders them, below the order with the fewest entries of the factors.
        That takes 4 to 7 billion operations instead of 8 to 11 at 35,000, and on two threads no longer, although its
        tree of fronts is narrower; the same at 45,000. Dissection gains a tenth at 67,000 and at 200,000, because the
        analysis is shorter and the fronts are larger.
    large, share_of_memory : int, float
        From so many unknowns on it is checked whether factors fit into this share of the memory of the machine.
    smallest_pivot : float
        Size to which smaller scaled pivots are lifted in single precision. Incompressible rubber has zeros on the
        diagonal. What round-off made of them in bent states and next to paper spoiled the factors, so that double ones
        had to be made.
    refinements, settling : int, float
        Refinements at most of a solution from single precision factors, and the share of the residual that each must
        be below: ten cost less than factors in double precision.
    accelerated_from, accelerated : int
        From so many unknowns on GMRES refines where that is not so, in so many iterations at most. A solution costs a
        thirtieth of the factors from 43,000 unknowns on; at 35,000 of tetrahedra it costs a twentieth, and the demo
        took a tenth longer so.
    many_prescribed : float
        Share of prescribed unknowns from which they are left out of the factorization: in an axisymmetric mesh, most
        are.
    rubbing_residual, rubbing_solves : float, int
        With friction, GMRES solves to this relative residual, with at most so many preconditioned steps.
    """

    small: int = 10_000
    dissected_from: int = 40_000
    large: int = 300_000
    share_of_memory: float = 0.6
    smallest_pivot: float = 1e-5
    refinements: int = 10
    settling: float = 0.7
    accelerated_from: int = 40_000
    accelerated: int = 12
    many_prescribed: float = 0.25
    rubbing_residual: float = 1e-4
    rubbing_solves: int = 40


LINEAR_SOLVER = LinearSolverSettings()


@dataclass(frozen=True, slots=True)
class IterativeSolverSettings:
    """Settings of the iterative solver.

    Parameters
    ----------
    iterations : int
        Iterations after which a tangent is factored instead: what they cost by then is about a factorization.
    schur_weight : float
        Weight of the mass over the shear modulus. Measured on tangents of benders and PneuNets: 2 and 4 need about as
        many iterations, 1 a tenth more, 0.5 a third more.
    """

    iterations: int = 160
    schur_weight: float = 2.0


ITERATIVE_SOLVER = IterativeSolverSettings()


@dataclass(frozen=True, slots=True)
class EquationSettings:
    """Settings of linear equations between displacements.

    Parameters
    ----------
    round_off : float
        Factors below this share of the largest in their equation count as zero. Directions of nodes have errors of
        1e-16, files have 9 digits at least where they state directions.
    tied_within : float
        A node this near to a face that it is tied to lies on it, as a share of the size of the part: what a gap keeps
        its direction for is no more than that.
    """

    round_off: float = 1e-9
    tied_within: float = 0.005


EQUATIONS = EquationSettings()
