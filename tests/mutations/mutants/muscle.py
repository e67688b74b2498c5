"""Mutants of muscle: bridges, passive laws, supports."""

from tests.mutations.mutant import changes

MUSCLE = "tests/heart/muscle"
BCS = f"{MUSCLE}/test_bcs.py"
MOONEY = f"{MUSCLE}/test_mooney_rivlin.py"
EXPONENTIAL = f"{MUSCLE}/test_guccione.py"

MUSCLE_MUTANTS = (
    *changes(
        "heart/muscle/fibre_equation.py",
        BCS,
        (
            "destruction by motion dropped",
            "x, formed = dt * rate + alpha * abs(d),",
            "x, formed = dt * rate,",
        ),
        (
            "motion mends bridges",
            "shrink = 1.0 / (1.0 + 0.25 * (dt * rate + alpha",
            "shrink = 1.0 / (1.0 + 0.25 * (dt * rate - alpha",
        ),
        (
            "bridges attach without tension",
            "formed * sigma_0 * inverse, 0.25",
            "0.0 * sigma_0 * inverse, 0.25",
        ),
        ("attaching bridges share no stress", "abs(d)) + loss)", "abs(d)))"),
        ("friction pushes", "tau + mu * d / dt - c,", "tau - mu * d / dt - c,"),
        ("friction of a relaxed sarcomere is zero", "mu * (rest + (1.0 - rest) * bound)", "mu * bound"),
        ("friction without its slope", "(mu + mu_d * d) / dt - c_d", "mu / dt - c_d"),
        (
            "fibre slope without the sarcomere",
            "change, s_e + s_d * increment_slope, d + change",
            "change, s_e, d + change",
        ),
    ),
    *changes(
        "heart/muscle/bcs.py",
        BCS,
        ("lambda ends at its mean", "new[2, i] = 2.0 * mean - lam", "new[2, i] = mean"),
        ("one fibre ends the steps of all", "unsolved += not solved", "unsolved = not solved"),
        ("one joint step is the last", "e_new, state, out) == 0:", "e_new, state, out) >= 0:"),
    ),
    *changes(
        "heart/muscle/spring.py",
        BCS,
        ("spring pulled by the old strain", "mean = 0.5 * (es_old + es_new)", "mean = es_old"),
    ),
    *changes(
        "heart/muscle/passive.py",
        MOONEY,
        ("first invariant not isochoric", "a * (identity - I1 / 3.0 * entry)", "a * identity"),
        ("second invariant's sign", "(I1 * identity - C[e, i] -", "(I1 * identity + C[e, i] -"),
        ("tangent lacks the I2 term", " + 2.0 / 3.0 * I2 * odot)", ")"),
        ("in-plane stress lacks the radial part", "(stretch - stretch**-5)", "(stretch)"),
    ),
    *changes(
        "heart/muscle/guccione.py",
        EXPONENTIAL,
        ("not isochoric", "(H[i] - trace / 3.0 * Ci[i])", "H[i]"),
        ("tangent of the exponential halved", "2.0 * H[i] * H[k] +", "H[i] * H[k] +"),
        ("fibres do not mix", "0.5 * b[1] * mixed + b[2] * unit", "b[2] * unit"),
    ),
    *changes(
        "heart/muscle/tissue.py",
        f"{MUSCLE}/test_support.py",
        (
            "the pericardium sticks",
            "moduli[:, None, None] * unit[:, :, None] * unit[:, None, :]",
            "moduli[:, None, None] * np.eye(3)",
        ),
        ("no stiffer apex", "(1.0 + (self.apical - 1.0) * ramp)", "(1.0 + 0.0 * ramp)"),
    ),
    *changes(
        "heart/muscle/stiffened.py",
        f"{MUSCLE}/test_stiffened.py",
        ("an added energy not isochoric", "(A[i] - third * Ci[i])", "A[i]"),
        ("an added tangent without curvature", "b * slope[i] * slope[j] + a * bent", "a * bent"),
        ("a sphere's stiffening forgets its own bend", " + first * curve", ""),
    ),
    *changes(
        "heart/muscle/control.py",
        f"{MUSCLE}/test_control.py",
        ("a tail from the activation on", "np.maximum(duration - self.duration, 0.0)", "duration"),
        ("a tail hastens", "rate = rate - self.k_RS", "rate = rate + self.k_RS"),
    ),
)
