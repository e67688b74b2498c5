"""Row numbers of the three tables of the compiled beat, whose columns are the sides of the heart, fibres and branches.

The state is held in plain tables instead of objects: compiled code counts the references of every array that it
receives in an object, at a higher cost than the physics.
"""

from heartfit.roles.laws import STATE_ROWS

# table of the sides: constants of the sphere and of its artery
RADIUS, RATIO, WALL, R_P, TAU, Z_C, L, P_VE, OWN_COMPLIANCE = range(9)

# quantities that a step advances, stored at three times: now, one step before and two steps before
STRETCH, SPEED, ARTERY, P_C, Q_L = range(5)
REMEMBERED = 5
NOW, BEFORE, OLDER, START = (9 + REMEMBERED * time for time in range(4))
"""First rows of the values at the three times, and of the starting values of the step."""

START_VOLUME, START_PLANE, START_RADIAL = range(29, 32)
"""Starting values of the cavity volume, and of the squared stretches in the plane and along the radius."""

X, X_BEFORE, P, STIFFNESS, STRESS = range(32, 37)
"""Trial stretch, the previous one, cavity pressure, its derivative without loads, mean stress of the last step."""

VOLUME, COMPLIANCE, LOADING = range(37, 40)
"""Trial volume, its derivative by the transmural pressure, and that of the outside pressure by the mean volume."""

SIDE_ROWS = 40

# table of the fibres: state and drive as in bcs; mean stress and increment of e_c at a trial stretch, with their slopes
E_C, K_C, LAMBDA, RATE, U, U_PLUS, N_0, SIGMA, SLOPE, INCREMENT, INCREMENT_SLOPE = range(11)
KEPT = 11
"""Share of the bridges of the fibre that no mechanism removes."""

FIBRE_ROWS = 12

# table of the branches: inertance, rates of opening and closing; flow and opening now, and one step before
INERTANCE, OPENS, CLOSES, FLOW, OPENING, FLOW_BEFORE, OPENING_BEFORE = range(7)
STEP_STATES = 7
"""First of the rows of :mod:`heartfit.roles.laws` for the step."""

BRANCH_ROWS = STEP_STATES + STATE_ROWS

SOLVED, UNBALANCED, OVERSTRETCHED, NO_STIFFNESS, NO_FIBRE_SOLUTION = range(5)
"""Outcomes of a step."""
