"""Thresholds of continuation: every number that was chosen, with its reason."""

# --- arc scaling

#: The displacement counts at most this many times as much as the largest load so far.
SCALE_GROWTH = 4.0

# --- branch jump

#: A step in which a body moves this many times as much for its load as in the step before may have jumped. Towards a
#: limit point steps get shorter, and the factor from one to the next stays at two or three.
JUMP_RATIO = 5.0

#: A step that moves a body by less than this share of its displacement is no jump.
STILL_SHARE = 1e-2

# --- branch switch

#: Longest step by volume, in the injected volume at which it takes over, over the longest step of the load.
LONGEST_VOLUME_STEP = 4.0

#: First step by volume at most, in the same measure: load control has failed, so a limit point is near.
FIRST_VOLUME_STEP = 0.05

#: Longest arc over the longest step of the load.
LONGEST_ARC = 2.0

#: Smallest step of load control before `Auto` prescribes the volume or the arc length instead.
AUTO_MIN_STEP = 2e-3

# --- cavity control

#: A cavity with less than this share of the box around the body has no volume.
NO_VOLUME = 1e-9

# --- continuity

#: The chord of a step has this cosine at least with the directions of the path at both of its ends.
STRAIGHT_CHORD = 0.8

#: At a corner of the path, as where walls meet, no step is short enough for that: this much suffices after so many
#: cuts.
CORNER_CHORD, CORNER_CUTS = 0.4, 4

#: Halvings of the step in which a bifurcation lies, fewest and most, and the share of its load to which it is found.
FEWEST_HALVINGS, HALVINGS, BIFURCATION_CLOSE = 6, 10, 1e-3

#: The remaining step may be longer than along a smooth path by this factor; beyond that it is a jump.
BIFURCATION_JUMP = 4.0

# --- extrema

#: A slope times the width of the step is flat below this share of the value.
FLAT_SLOPE = 1e-6

# --- limit points

#: Solves at most to find one limit point.
LIMIT_POINT_SOLVES = 8

# --- load control

#: Pseudo-transient continuation is tried this often in a run where no step succeeds, over at most this share of the
#: load, and if that fails over a smaller one.
RELAXATIONS, RELAXATION_REACH, SHORTER_RELAXATION_REACH = 20, 0.05, 0.1

#: Where a film wrinkles, such a state may be this share of the displacement away: the film snaps from fold to fold.
FOLD_SHARE = 0.1

#: If the first step is at least this share of the load, the response to a small load is computed first.
LONG_FIRST_STEP = 0.2

# --- path reversal

#: Share of the largest load below which a path is compared with the way there; nearer to it both are alike.
REVERSAL_FALLEN = 0.95

#: A path that goes on is at least as far from the former path as that is from the turn; a path that returns is nearer
#: than this share.
REVERSAL_NEAR = 0.3

# --- predictor

#: States used at most: a quartic through the last five.
HISTORY = 5

#: A step so many times as long as the last one is far: the first steps of a path are then compared with staying where
#: they begin. Steps grow to twice the length; a load that acts at once is followed by one that is thousands of times
#: longer.
FAR = 4.0

#: States used where sheets wrinkle, for a parabola. Four films (one chamber to 30 kPa, one with thick walls
#: to 50, five to 15, paper to 60) took 210, 197 and 241 iterations with 2, 3 and 5 states, and 289 with stress
#: and strain of the sheet extrapolated by the same order as the displacement instead of a line.
WRINKLING_HISTORY = 3

#: An extrapolation that leaves a smaller relative residual is taken without trying a lower order.
GOOD_PREDICTION = 0.05

#: Where a smaller share of the points that touch would still touch along the tangent, it leads off a curved body. Of
#: 63 points of a belt that slides on a drum, the tangent kept 12.
STAYS_ON = 0.8

#: An extrapolation is shortened this often at most where it presses walls into each other.
SHORTENINGS = 3

# --- step acceptance

#: In one step no support leaves the straight line to its next place by more than this share of its length; on a circle
#: that is a quarter turn.
SUPPORT_ASIDE = 0.2

# --- step control

#: Iterations of a step that is neither too easy nor too hard.
COMFORTABLE_ITERATIONS = 6

#: The same where sheets wrinkle: each step finds anew which points are slack, in 6 to 9 iterations whatever its length.
WRINKLING_ITERATIONS = 9

#: The same where walls touch: each step finds anew which points do; with 9, blocked fingers took up to a third more. A
#: step grows by the second factor at most there: 1.5, 2 and 3 took 1109, 1037 and 1041 iterations in sixteen cases with
#: contact, and 303, 282 and 258 in the four of them that are fingers with paper.
TOUCHING_ITERATIONS, TOUCHING_GROWTH = 7, 3.0

#: An easy step that was shortened, so that walls meet gently, is followed by one of this share of the length that it
#: would have had, at least: with 0, 0.3 and 0.5 six blocked fingers took 450, 448 and 436 iterations, a seventh 61, 61
#: and 52, and six other cases with contact 332, 327 and 342.
TOUCHING_SHARE = 0.5

#: A failed step is tried again with this share of its length.
STEP_CUT = 0.35

#: A run ends where half of so many attempts failed and the others advanced by less than this share of the load. With
#: the usual smallest step they advance farther; a run that may take steps of 1e-8 made 945 attempts.
CREEPING_ATTEMPTS, CREEPING_ADVANCE = 60, 1e-3

#: The last stretch to a target is taken whole if it is no longer than this many steps.
STRETCH = 1.25

#: A load factor that was asked for this near a kink is the kink.
ROUND_OFF = 1e-12

#: In steps shorter than the first one the tolerance shrinks with them, to no less than this. Of twelve columns bowed by
#: 5e-6 to 5e-5 of their length, eleven pass their buckling load so, and seven or eight with the same tolerance.
SMALLEST_TOLERANCE = 1e-9

#: Load factors between targets are rounded to this many digits, so that tables read well.
LOAD_DIGITS = 6

# --- tangent response

#: A step that moves a body this many times as far as the faster of the rates at its ends has left the path.
FARTHER_THAN_RATES = 2.0
