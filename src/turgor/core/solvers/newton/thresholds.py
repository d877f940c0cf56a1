"""Thresholds of Newton's method: every number that was chosen, with its reason."""

# --- contact newton

#: Times that friction and stiffness are renewed at most.
CONTACT_PASSES = 20

#: A state is accepted if the residual is at most this many times the tolerance after a new search for contact.
SEARCHED_ANEW = 10.0

#: From this pass on a state is also accepted if the residual is at most this much: in the wedge of a kink between two
#: sides a point changes its partner with every search, although the gap hardly changes.
CONTACT_PATIENCE, WEDGED = 3, 1e-3

# --- convergence

#: Forces are compared with at least this share of the full load. Where all pressures have fallen back to zero, there is
#: nothing else but round-off to compare with.
SMALL_FORCE = 1e-5

#: Scaled force on a node with which forces are compared at least, as where a body is moved that nothing loads.
UNLOADED = 3e-8

#: The partners of contact are searched for in this many updates, then kept: at a wedge they may change forever.
KEEP_PARTNERS_AFTER = 8

#: They are kept earlier where the residual is this small and falls no more.
STAGNATING_BELOW = 0.05

#: So many updates in a row that leave a residual below the second number, and do not halve it, may be at round-off. Its
#: estimate was ten times what stiff films left.
STAGNATING_UPDATES, ROUND_OFF_BELOW = 3, 1e-5

# --- inertia correction

#: Updates before it gives up, and how far a node may move from the start, in mean edge lengths: a larger motion is not
#: due to a few points that separate.
INERTIA_UPDATES, INERTIA_REACH = 40, 0.5

#: The first shift of the diagonal, in scaled units, in which a cube of rubber has a stiffness of about 3; the factor
#: from one to the next, and the largest.
FIRST_SHIFT, SHIFT_FACTOR, LARGEST_SHIFT = 0.016, 4.0, 100.0

#: No shift is tried first once the residual is this small.
UNSHIFTED_BELOW = 1e-3

#: An update is too long if the force along it reverses and exceeds this share of its former size.
INERTIA_OVERSHOT = 0.5

#: Shortest share of an update that is tried, and the smallest factor from one to the next.
INERTIA_SHORTEST, INERTIA_LEAST_SHARE = 0.005, 0.1

#: The partners of contact are kept from this update on: at a wedge they may change forever.
INERTIA_KEEP_PARTNERS_AFTER = 20

# --- line search

#: Shortest update that the line search tries; and where walls are pressed into each other.
SHORTEST_STEP = 1.0 / 64
SHORTEST_TOUCHING_STEP = 1.0 / 32

#: With friction, an update is too long if the force along it reverses and exceeds this share of its former size.
OVERSHOT = 0.9

#: Without friction, one after which other points touch is too long only if it exceeds so many times that: a hundred
#: where Newton's method goes round between contact states. In six blocked fingers and seven other cases, 10, 20 and
#: 80 took 869, 843 and 870 iterations, and 880 without this limit.
OVERSHOT_TOUCHING = 20.0

# --- newton

#: Old factors are used once the residual is this small and while each update reduces it below a tenth. Earlier they are
#: harmful: while a stiff membrane is being straightened, a falling residual does not show that the factors are good.
KEEP_FACTORS_BELOW = 1e-3
KEEP_FACTORS_CONTRACTION = 0.1

#: Where a body has moved by more than this share of its largest displacement since the tangent was last factored, its
#: factors do not count the unstable modes of where it is.
STALE_FACTORS = 0.05

#: It gives up where so many updates in a row are cut to the shortest because they press walls too deep.
CUT_SHORT = 3

#: It also gives up where walls touch and so many updates have not brought the residual below this share of the first.
#: Fifteen updates were never better then, and a shorter step is cheaper than they are.
VAIN_UPDATES, VAIN_SHARE = 6, 0.5

# --- pseudo transient

#: The first viscous step moves no node by more than about this many edge lengths.
VISCOUS_FIRST_MOVE = 0.5

#: Viscosity over the stiffness of the body with which that move is foreseen, and the smallest first viscosity.
ALMOST_RIGID, SMALLEST_VISCOSITY = 100.0, 1e-9

#: After a step of few iterations the viscosity falls by the first factor, after others by the second; where a step
#: fails it rises by the third.
QUICK_ITERATIONS, VISCOSITY_AFTER_QUICK, VISCOSITY_AFTER_STEP, VISCOSITY_AFTER_FAILURE = 4, 0.1, 0.3, 8.0

#: Iterations at most, and failures in a row.
PSEUDO_TRANSIENT_ITERATIONS, PSEUDO_TRANSIENT_FAILURES = 150, 6

#: Without viscosity it is tried once the viscosity has fallen to this share of the first one.
FADED_VISCOSITY = 1e-3

#: Once it has fallen to this share of that, an unstable state will not be left any more.
GONE_VISCOSITY = 1e-3

#: Relative residual of a viscous step: it is on the way only.
ROUGH_RESIDUAL = 1e-3
