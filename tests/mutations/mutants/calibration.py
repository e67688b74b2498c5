"""Mutants of sigma points and the update."""

from tests.mutations.mutant import changes

UNSCENTED = "tests/calibration/test_unscented.py"
UPDATE = "tests/calibration/test_update.py"

CALIBRATION_MUTANTS = (
    *changes(
        "calibration/unscented.py",
        UNSCENTED,
        ("deviations from the centre, not the mean", "deviation = z - mean", "deviation = z - z[0]"),
        ("a mean by weights of the covariance", "mean = mean_weight @ z", "mean = weight @ z"),
        (
            "points along the axes",
            "np.linalg.cholesky(prior.covariance).T",
            "np.diag(np.sqrt(np.diag(prior.covariance)))",
        ),
        (
            "a failed point counts as zero",
            "z = design.filled(z, complete, labels)",
            "z = np.where(complete[:, None], z, 0.0)",
        ),
        ("cross-covariance without weights", "(weight[:, None] * (x - x[0])).T", "(x - x[0]).T"),
    ),
    *changes(
        "calibration/design.py",
        UNSCENTED,
        ("points too near", "np.sqrt(self.spread(n)) *", "1.0 *"),
        ("no extra weight of the centre", "covariance[0] += 1 - self.a**2 + self.b", "covariance[0] += 0.0"),
        (
            "a lost point repeats its partner",
            "up[~has_up] = 2.0 * filled[0] - down[~has_up]",
            "up[~has_up] = down[~has_up]",
        ),
    ),
    *changes(
        "calibration/design.py",
        "tests/calibration/test_simplex.py",
        (
            "corners too near",
            "1.0 / np.sqrt((j + 1) * (j + 2) * weight)",
            "0.5 / np.sqrt((j + 1) * (j + 2) * weight)",
        ),
        ("a lost corner is the centre", "filled[index] = corners * z[0] - ", "filled[index] = z[0] - 0.0 * "),
    ),
    *changes(
        "calibration/update.py",
        "tests/calibration/test_iterated.py tests/study/test_iterations.py",
        ("the prior moves along", "(prior.mean - around.mean) @ slope", "0.0 * prior.mean @ slope"),
        ("points of a second iteration do not shrink", "factor**2 * prior.covariance", "prior.covariance"),
        (
            "a second iteration starts at the prior",
            "Gaussian(prior.names, estimate, factor",
            "Gaussian(prior.names, prior.mean, factor",
        ),
    ),
    *changes(
        "calibration/alternatives.py",
        "tests/calibration/test_iterated.py",
        ("points never shrink", "spread *= shrink", "spread *= 1.0"),
    ),
    *changes(
        "calibration/alternatives.py",
        "tests/calibration/test_alternatives.py",
        ("noise not inflated", "np.sqrt(assimilations) * np.linalg", "1.0 * np.linalg"),
    ),
    *changes(
        "calibration/update.py",
        UPDATE,
        ("the step backwards", "shift = gain @ (z - moments.mean)", "shift = gain @ (moments.mean - z)"),
        (
            "nothing is learnt",
            "covariance = prior.covariance - (gain",
            "covariance = prior.covariance - 0.0 * (gain",
        ),
        (
            "the noise of the observations is ignored",
            "total = cov_zz if noise is None else cov_zz + noise",
            "total = cov_zz",
        ),
        ("noise counts as a deviation", "else cov_zz + noise", "else cov_zz + np.sqrt(noise)"),
        ("a step in units of its variance", "step = shift / prior.sd", "step = shift / prior.sd**2"),
        (
            "the gain forgets the units of the observations",
            "(moments.cov_xz / scale).T).T / scale",
            "(moments.cov_xz / scale).T).T",
        ),
    ),
)
