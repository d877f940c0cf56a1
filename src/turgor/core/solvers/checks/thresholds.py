"""Thresholds of the checks: every number that was chosen, with its reason."""

# --- causes

#: A law turns over where its stress has an extreme at this many times the stretch that was reached, or before.
TURNS_AHEAD = 1.05

#: Share of the volume of a region beyond an extreme of its law, from which the law is named as the cause. A few cells
#: suffice: where the stress falls, the strain concentrates in them, and they collapse.
TURNED_VOLUME = 1e-3

#: Rubber stretched less than this is not near any extreme of its law, and its wall is no balloon.
STRETCHED = 1.15

#: A cavity of this many times its volume at rest is a balloon.
BALLOON = 1.3

#: Stretch that elastomers bear (strains over 500 %, Xavier et al. 2021), where the tests of a law are not known.
BREAKS = 6.0

#: Share of the area of a film that is compressed enough to wrinkle, from which wrinkles are named as the cause.
WRINKLED_AREA = 0.02

#: Compression that counts, as a share of the largest force per width in the sheet: less is round-off of a taut sheet.
LITTLE_COMPRESSION = 1e-3

#: Energy of the bending that a membrane leaves out, over that of the actuator, from which it changes the result: five
#: chambers on paper of 0.1 mm, with 6 %, bend by 9 % less once it counts.
BENDING_COUNTS = 0.02

# --- contact

#: A tolerance that is just met is met.
PENETRATION_ROUND_OFF = 1e-6

#: Share of the largest displacement from which elastic slip of points that stick is reported.
ELASTIC_SHARE = 0.1

# --- plate

#: Mean distance from the tip at which a plate is touched, as a share of the longest side of the actuator, from which it
#: is not the tip that bears. An edge of the tip has 0.6 % (a finger of 3 chambers on cells of 5 mm, whose sides spread
#: the force), a chamber whose floor bulges towards the plate 13 to 19 %.
BEHIND_TIP = 0.05

# --- distortion

#: Rubber keeps its volume, a mesh keeps it on average. Where a point of a cell has less than this share of its volume
#: left, or the inverse of it, the cell bends in a way that the rubber cannot.
KEPT_VOLUME = 0.5

#: Rubber whose bulk modulus is this many times its shear modulus or more keeps its volume.
HARD_RUBBER = 50.0

# --- fibers

#: Distance between smeared threads, in cells and as a share of the perimeter, from which smearing them is doubtful.
CELLS_BETWEEN, SHARE_OF_PERIMETER = 1.5, 0.25

#: Difference between the distance of discrete threads and the one that was asked for, from which it is said, and from
#: which it is a warning.
OTHER_SPACING, WRONG_SPACING = 0.02, 0.1

#: Angle from the axis [rad], 80°, from which threads of both hands are nearly hoops, and count twice.
NEARLY_HOOPS = 1.396

#: Stiffness of slack-prone threads over that of the wall below them, per width, from which they are too stiff to be
#: solved: which of them are slack changes from iteration to iteration. Tubes with 10,000 times took 140 iterations,
#: with 50,000 times none converged; Kevlar of 0.18 mm every 2 mm has 800.
TOO_STIFF = 20_000.0

#: A stiffness of this many times the wall is as good as rigid.
RIGID = 2_000.0

# --- obstacles

#: Obstacles may reach into the actuator by this share of its longest side: what just touches overlaps by round-off.
OBSTACLE_TOUCHING = 1e-4

# --- time steps

#: Steps longer than the first of these shares of a relaxation time are inaccurate. Terms much faster than the steps,
#: beyond the second, are always nearly relaxed and do no harm.
LONG_RELAXATION_STEP, FAST_RELAXATION = 0.6, 20.0

#: A step in which no node moves by more than this share of the largest displacement counts as a hold, which is exact.
HELD_SHARE = 0.02
