"""The three tables of the compiled beat, one column per side of the heart, fibre or branch, and their rows.

Plain tables and not objects: compiled code counts the references of every array it is handed in an object, which costs
more than the physics.
"""

# a side: constants of the sphere and of its artery
RADIUS, RATIO, WALL, R_P, TAU, Z_C, L, P_VE, OWN_COMPLIANCE = range(9)

# what a step advances, and how often it is remembered: now, before the last step, before the one before it
STRETCH, SPEED, ARTERY, P_C, Q_L = range(5)
REMEMBERED = 5
NOW, BEFORE, OLDER, START = (9 + REMEMBERED * time for time in range(4))
"""First rows of the memory and of the starting values of a step."""

START_VOLUME, START_PLANE, START_RADIAL = range(29, 32)
"""Starting values of the cavity volume and of the squares of the stretch in the plane and along the radius."""

X, X_BEFORE, P, STIFFNESS, STRESS = range(32, 37)
"""Trial stretch and the one before it, cavity pressure and its derivative at no load; mean stress of the last step."""

VOLUME, COMPLIANCE, LOADING = range(37, 40)
"""Trial volume, its derivative by the pressure across the wall, that of the pressure outside by the mean volume."""

SIDE_ROWS = 40

# a fibre: state as in bcs, drive, and response to a trial stretch: mean stress, its slope, increment of e_c, its slope
E_C, K_C, LAMBDA, RATE, U, U_PLUS, N_0, SIGMA, SLOPE, INCREMENT, TURN = range(11)
KEPT = 11
"""Share of a fibre's bridges that no mechanism takes away."""

FIBRE_ROWS = 12

# a branch: inertance, flow now and before the last step; inertance per length and starting flow of a step, trial flow
INERTANCE, FLOW, FLOW_BEFORE, PER_STEP, START_FLOW, TRIAL_FLOW = range(6)
BRANCH_ROWS = 6

DONE, UNSOLVED, OVERSTRETCHED, SOFT, TORN = range(5)
"""Outcomes of a step."""
