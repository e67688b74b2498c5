"""Mutants of the refit in 3-D: starts, slopes, evidence, and the size from all samples."""

from tests.mutations.mutant import changes

REFIT_MUTANTS = (
    *changes(
        "discovery/refit/refit.py",
        "tests/discovery/refit/test_linear_refit.py",
        (
            "the evidence of a refit ignores the prior",
            "gradient @ step + volume + kept)",
            "gradient @ step + kept)",
        ),
        (
            "half the prior of an amplitude is lost",
            "gradient @ step + volume + kept)",
            "gradient @ step + volume)",
        ),
        (
            "an amplitude at its bound counts as a minimum",
            "volume, kept = laplace(descent.x + step,",
            "volume, kept = laplace(descent.x,",
        ),
        ("the slope at a bound adds nothing", "+ 0.5 * gradient @ step", ""),
        (
            "renewed slopes are thrown away",
            "slopes: Floats = np.where(np.isnan(fitted), known, fitted)",
            "slopes: Floats = known",
        ),
        (
            "renewed slopes of the other half",
            "fitted = self.complete_slopes[self.complete.rows_of(self.target.samples)]",
            "fitted = self.complete_slopes[~self.complete.rows_of(self.target.samples)]",
        ),
        (
            "differences without their step",
            "else (other - centre) / around.step",
            "else other - centre",
        ),
        (
            "an extension starts without the base",
            "start = np.concatenate([base.estimate, extension.start(0.5)[base.estimate.size :]])",
            "start = extension.start(0.5)",
        ),
        (
            "an amplitude may turn negative",
            "problem = InverseProblem(forward, target.values(), target, lower)",
            "problem = InverseProblem(forward, target.values(), target, lower - np.inf)",
        ),
        (
            "the final size ignores the prior",
            "covariance @ (slope - fit.estimate)",
            "covariance @ slope",
        ),
        (
            "the final interval ignores the prior",
            "covariance = np.linalg.inv(np.eye(fit.estimate.size) + gram)",
            "covariance = np.linalg.inv(gram)",
        ),
        (
            "the final size leaves its bound",
            "covariance @ (slope - fit.estimate), lower),",
            "covariance @ (slope - fit.estimate), -np.inf),",
        ),
    ),
    *changes(
        "discovery/refit/model.py",
        "tests/discovery/refit/test_nearby_beats.py",
        (
            "slopes of another point",
            "points = points_around(x, TANGENT)",
            "points = points_around(0.0 * x, TANGENT)",
        ),
    ),
    *changes(
        "discovery/refit/target.py",
        "tests/discovery/refit/test_linear_refit.py",
        (
            "samples weigh without their noise",
            "weighted = np.linalg.solve(self.covariance, jacobian)",
            "weighted = jacobian",
        ),
        ("a misfit counts twice", "return -0.5 * float(residual @", "return -1.0 * float(residual @"),
    ),
)
