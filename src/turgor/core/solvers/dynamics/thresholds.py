"""Thresholds of time stepping, stabilization and vibrations: every number that was chosen, with its reason."""

# --- initial motion

#: Largest displacement, in edge lengths, of the differences along the velocity.
DIFFERENCE = 1e-3

# --- initial stiffness

#: Half the stiffness of a body that nothing holds, in shear moduli over the square of its size; as of a bar of rubber.
FREE_STIFFNESS = 1.5

# --- modes

#: The first shift, as a share of (speed of shear waves / size of the body)², negative: below the slowest vibration.
FIRST_SHIFT = 1e-3

#: Relative residual of solutions in the Lanczos iterations, and how often they are refined at most.
LANCZOS_RESIDUAL, LANCZOS_REFINEMENTS = 1e-12, 4

#: How often the shift is moved down until no mode is below it.
SHIFT_LOWERINGS = 12

#: An eigenvalue this much smaller than the first shift is that of a rigid motion, not of an instability.
RIGID_SHARE = 1e-3

# --- stabilization

#: A step that leaves more of the strain energy unaccounted for than this share went too far, and is tried shorter.
ENERGY_ERROR = 1e-2

#: A step that moves nothing by more than this many edge lengths is no jump.
SMALL_MOVE = 1e-3

#: Where steps fall below the smallest, the viscosity is raised by this factor, so many times.
RAISE, RAISES = 10.0, 3

#: While the load is held, each step is this many times as long as the last, up to so many.
HOLD_GROWTH, HOLDS = 2.0, 80

# --- time step control

#: A step whose error is this many times the accuracy is rejected.
TAKEN_BACK = 2.0

#: Share of the length at which the error is expected to meet the accuracy, and bounds of its change.
TIME_STEP_SAFETY, TIME_STEP_SHRINK, TIME_STEP_GROW = 0.9, 0.3, 1.5

#: Changes of the length between these factors are not worth new factors of the tangent.
STEADY_TIME_STEP = (0.85, 1.25)

#: A step in which Newton's method failed is tried again with this share of its length.
TIME_STEP_CUT = 0.5

#: The last stretch to a target is taken whole if it is no longer than this many steps, in two halves up to twice that.
TIME_STRETCH = 1.05

# --- time stepping

#: The error of a step is compared with the largest displacement so far, at least with this share of the body's size.
SMALL_DISPLACEMENT = 1e-5

#: Factors of the tangent are used again in a step whose length differs by no more than this share.
SAME_LENGTH = 0.02
