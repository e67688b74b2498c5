"""Mutants of the search: evidence, steps and starts of its fits, predictions, and the next measurement."""

from tests.mutations.mutant import changes

INFERENCE = "tests/discovery/inference"
WALK, OPTIMISE = "tests/discovery/refit/test_walk.py", f"{INFERENCE}/test_optimise.py"
STARTS = f"{INFERENCE}/test_starts.py"
LOCAL_MINIMUM = f"{INFERENCE}/test_traps.py::test_a_base_fit_in_a_local_minimum_is_detected"

SEARCH_MUTANTS = (
    *changes(
        "discovery/inference/data.py",
        f"{INFERENCE}/test_whitening.py",
        ("levels of the noise add up", "_log_sum(level) - np.log(level.size)", "_log_sum(level)"),
    ),
    *changes(
        "discovery/inference/hypothesis.py",
        "tests/discovery/sphere_model/test_forward_model.py",
        ("slopes from two limit cycles", "[(near, centre), *models]", "[(near, predicted), *models]"),
    ),
    *changes(
        "discovery/inference/evidence.py",
        f"{INFERENCE}/test_evidence.py {INFERENCE}/test_explanation.py",
        (
            "evidence without the posterior's volume",
            "return 0.5 * np.linalg.slogdet",
            "return 0.0 * np.linalg.slogdet",
        ),
        ("the interval of a size holds 68 %", "level: float = 0.95", "level: float = 0.68"),
        ("half a prior of one side", "share + bounded.size * np.log(2.0)", "share"),
        (
            "the prior shrinks reported amplitudes",
            "self.posterior.mean[index] / (1.0 - variance)",
            "self.posterior.mean[index]",
        ),
    ),
    *changes(
        "discovery/inference/orthant.py",
        f"{INFERENCE}/test_orthant.py {INFERENCE}/test_evidence.py",
        (
            "two one-sided amplitudes count as independent",
            "if mean.shape[-1] == 2:",
            "if mean.shape[-1] == 0:",
        ),
        ("the range about the peak stays wide", "in range(NARROWINGS):", "in range(1):"),
    ),
    *changes(
        "discovery/inference/context.py",
        f"{INFERENCE}/test_discrepancy.py",
        ("sizes of a discrepancy add up", " - np.log(len(DISCREPANCY_SIZES))", ""),
    ),
    *changes(
        "discovery/inference/descent.py",
        f"{WALK} {OPTIMISE}",
        ("the prior pulls nowhere", "return slope - x, np.eye", "return slope, np.eye"),
        ("a failed step is not shortened", "self.damping *= 10.0", "self.damping *= 1.0"),
        (
            "steps correct no slopes",
            "np.outer(missed, step) / (step @ step)",
            "0.0 * np.outer(missed, step)",
        ),
        (
            "amplitudes leave their bound",
            "step = np.maximum(self.x + step, self.problem.lower) - self.x",
            "step = step + 0.0",
        ),
    ),
    *changes(
        "discovery/inference/predicted_evidence.py",
        f"{INFERENCE}/test_predicted_evidence.py",
        (
            "a secant over the typical size only",
            "return (switched - before) / amplitude",
            "return switched - before",
        ),
        (
            "pairs without predicted gain are fitted",
            "[prediction for prediction in predictions if prediction.log_evidence > least]",
            "[prediction for prediction in predictions if prediction.log_evidence > -np.inf]",
        ),
    ),
    *changes(
        "discovery/inference/search.py",
        f"{STARTS} {LOCAL_MINIMUM}",
        (
            "no effect starts from the prior mean",
            "return context.improve(from_base, from_mean.fit.x, from_mean.fit.jacobian, patience=CENTRE_PATIENCE)",
            "return from_base",
        ),
        (
            "no effect starts from other amplitudes",
            "survey = settle_best(context, polish_best(context, survey, rules), rules)",
            "pass",
        ),
        (
            "the baseline stays in its local minimum",
            "        baseline = _refit_baseline(context, baseline, single)\n",
            "        pass\n",
        ),
        (
            "an effect may fit worse than none",
            "        if place >= LEADING and _not_worse(single, baseline)\n",
            "        if True\n",
        ),
    ),
    *changes(
        "discovery/inference/plan.py",
        f"{INFERENCE}/test_plan.py",
        ("a measurement is worth its best pair", "gain = min(divergence(", "gain = max(divergence("),
        ("any measurement decides", "decisive = prospect.gain >= DECISIVE", "decisive = True"),
        (
            "a measurement knows the parameters",
            "+ jacobian @ free @ jacobian.T",
            "+ 0.0 * jacobian @ free @ jacobian.T",
        ),
    ),
)
