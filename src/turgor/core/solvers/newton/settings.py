"""Settings of Newton's method: every number that was chosen, with its reason.

All are without unit unless it is stated; lengths are scaled with the mean edge length, stresses with a shear modulus.
`benchmarks/robustness/constants.md` says which of the robustness cases need them.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ContactNewtonSettings:
    """Settings of contact newton.

    Parameters
    ----------
    passes : int
        Times that friction and stiffness are renewed at most.
    after_search : float
        A state is accepted if the residual is at most this many times the tolerance after a new search for contact.
    patience, wedged : int, float
        From this pass on a state is also accepted if the residual is at most this much: in the wedge of a kink
        between two sides a point changes its partner with every search, although the gap hardly changes.
    """

    passes: int = 20
    after_search: float = 10.0
    patience: int = 3
    wedged: float = 1e-3


CONTACT_NEWTON = ContactNewtonSettings()


@dataclass(frozen=True, slots=True)
class ConvergenceSettings:
    """Settings of convergence.

    Parameters
    ----------
    small_force : float
        Forces are compared with at least this share of the full load. Where all pressures have fallen back to zero,
        there is nothing else but round-off to compare with.
    unloaded : float
        Scaled force on a node with which forces are compared at least, as where a body is moved that nothing loads.
    keep_partners_after : int
        The partners of contact are searched for in this many updates and then stay: at a wedge they may change forever.
    stagnating_below : float
        They stay from earlier on where the residual is this small and falls no more.
    stagnating_updates, round_off_below : int, float
        So many updates in a row that leave a residual below the second number, and do not halve it, may be at
        round-off. Its estimate was ten times what stiff films left.
    """

    small_force: float = 1e-5
    unloaded: float = 3e-8
    keep_partners_after: int = 8
    stagnating_below: float = 0.05
    stagnating_updates: int = 3
    round_off_below: float = 1e-5


CONVERGENCE = ConvergenceSettings()


@dataclass(frozen=True, slots=True)
class InertiaCorrectionSettings:
    """Settings of inertia correction.

    Parameters
    ----------
    updates, reach : int, float
        Updates before it gives up, and how far a node may move from the start, in mean edge lengths: a larger motion
        is not due to a few points that separate.
    first_shift, shift_factor, largest_shift : float
        The first shift of the diagonal, in scaled units, in which a cube of rubber has a stiffness of about 3; the
        factor from one to the next, and the largest.
    unshifted_below : float
        No shift is tried first once the residual is this small.
    overshot : float
        An update is too long if the force along it reverses and exceeds this share of its former size.
    shortest, least_share : float
        Shortest share of an update that is tried, and the smallest factor from one to the next.
    keep_partners_after : int
        The partners of contact are kept from this update on: at a wedge they may change forever.
    """

    updates: int = 40
    reach: float = 0.5
    first_shift: float = 0.016
    shift_factor: float = 4.0
    largest_shift: float = 100.0
    unshifted_below: float = 1e-3
    overshot: float = 0.5
    shortest: float = 0.005
    least_share: float = 0.1
    keep_partners_after: int = 20


INERTIA_CORRECTION = InertiaCorrectionSettings()


@dataclass(frozen=True, slots=True)
class LineSearchSettings:
    """Settings of line search.

    Parameters
    ----------
    shortest, shortest_touching : float
        Shortest update that the line search tries; and where walls are pressed into each other.
    overshot : float
        With friction, an update is too long if the force along it reverses and exceeds this share of its former size.
    overshot_touching : float
        Without friction, one after which other points touch is too long only if it exceeds so many times that: a
        hundred where Newton's method goes round between contact states. In six blocked fingers and seven other cases,
        10, 20 and 80 took 869, 843 and 870 iterations, and 880 without this limit.
    """

    shortest: float = 1.0 / 64
    shortest_touching: float = 1.0 / 32
    overshot: float = 0.9
    overshot_touching: float = 20.0


LINE_SEARCH = LineSearchSettings()


@dataclass(frozen=True, slots=True)
class FactorSettings:
    """When factors of the tangent are used again, and when Newton's method gives up.

    Parameters
    ----------
    below, contraction : float
        Old factors are used once the residual is this small and while each update reduces it below a tenth. Earlier
        they are harmful: while a stiff membrane is being straightened, a falling residual does not show that the
        factors are good.
    stale_factors : float
        Where a body has moved by more than this share of its largest displacement since the tangent was last
        factored, its factors do not count the unstable modes of where it is.
    cut_short : int
        It gives up where so many updates in a row are cut to the shortest because they press walls too deep.
    vain_updates, vain_share : int, float
        It also gives up where walls touch and so many updates have not brought the residual below this share of the
        first. Fifteen updates were never better then, and a shorter step is cheaper than they are.
    late_updates, late_share : int, float
        The same after more updates, with a smaller share: of 236 attempts with walls that touch, in 20 cases, this
        ends three of the six that failed after 15 updates, and none that converged.
    shortened_updates : int
        The same after so many updates, if the line search shortened all but the first: the demo takes 76 iterations
        instead of 87.
    """

    below: float = 1e-3
    contraction: float = 0.1
    stale_factors: float = 0.05
    cut_short: int = 3
    vain_updates: int = 6
    vain_share: float = 0.5
    late_updates: int = 10
    late_share: float = 0.1
    shortened_updates: int = 4


FACTORS = FactorSettings()


@dataclass(frozen=True, slots=True)
class PseudoTransientSettings:
    """Settings of pseudo transient.

    Parameters
    ----------
    first_move : float
        The first viscous step moves no node by more than about this many edge lengths.
    almost_rigid : float
        Viscosity over the stiffness of the body with which that move is foreseen.
    after_step, after_failure : float, float
        After a step the viscosity falls by the first factor; where a step fails it rises by the second. With a faster
        fall after easy steps, "plate of 0.1 mm blown up" takes 88 iterations instead of 73.
    iterations, iterations_of_films : int
        Iterations at most, and for films without a solid, which are cheap and unfold: a square airbag of 8 × 8 cells
        takes 200.
    after_step_of_films, after_failure_of_films : float, float
        The same for films without a solid.
    faded : float
        The equilibrium itself is tried once the viscosity has fallen to this share of the first one. Once it has
        fallen to this share of that, an unstable state will not be left any more.
    rough_residual : float
        Relative residual of a viscous step: it is on the way only.
    """

    first_move: float = 0.5
    almost_rigid: float = 100.0
    after_step: float = 0.3
    after_failure: float = 8.0
    iterations: int = 150
    iterations_of_films: int = 1500
    after_step_of_films: float = 0.5
    after_failure_of_films: float = 3.0
    faded: float = 1e-3
    rough_residual: float = 1e-3


PSEUDO_TRANSIENT = PseudoTransientSettings()
