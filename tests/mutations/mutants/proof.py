"""Mutants of the proof in 3-D: what is compared on held-out samples, what is kept, and its size."""

from tests.mutations.mutant import changes

UNSEEN = (
    "tests/discovery/refit/test_unseen.py::test_an_extension_helps_if_all_unseen_curves_together_come_nearer"
)
TRIAL = "tests/discovery/refit/test_trial.py"
COMPARISON = "tests/discovery/refit/test_comparison.py"

PROOF_MUTANTS = (
    *changes(
        "discovery/refit/verdict.py",
        UNSEEN,
        (
            "every extension helps on unseen data",
            "float(np.mean(strain)) < 0.0",
            "float(np.mean(strain)) < np.inf",
        ),
        (
            "fitted samples prove an extension",
            "in self.case.split.held.items())",
            "in self.case.split.fitted.items())",
        ),
    ),
    *changes(
        "discovery/refit/verdict.py",
        "tests/discovery/refit/test_unseen.py::test_the_strain_votes_on_an_extension",
        ("the strain has no vote", "gain.ratio**2 - 1.0 for", "0.0 for"),
    ),
    *changes(
        "discovery/refit/verdict.py",
        COMPARISON,
        (
            "a small error within the noise counts in full",
            "self.case.deviation(name) ** 2 + before",
            "before",
        ),
        ("curves are compared in their units", "(self.case.deviation(name) ** 2 + before)", "1.0"),
        (
            "gains on fitted samples",
            "for name, held in case.split.held.items():\n        before",
            "for name, held in case.split.fitted.items():\n        before",
        ),
    ),
    *changes(
        "discovery/refit/prove.py",
        COMPARISON,
        (
            "an extension is compared with itself",
            "self.registered, baseline.shown, extended.shown)",
            "self.registered, extended.shown, extended.shown)",
        ),
        (
            "a trial is proved against itself",
            "self.proof(base, tried).helps()",
            "self.proof(tried, tried).helps()",
        ),
        (
            "the final size is judged at the prior mean",
            "return stack(sample(fitted.shown.curves, self.complete.samples))",
            "return 0.0 * stack(sample(fitted.shown.curves, self.complete.samples))",
        ),
    ),
    *changes(
        "results/discovery.py",
        "tests/results/test_discovery_table.py",
        (
            "the factor printed is that of the weakest mechanism",
            "owner, factor = max(ranked.items()",
            "owner, factor = min(ranked.items()",
        ),
        (
            "the factor printed is the largest of the ranking",
            "elif ranked := factors or {",
            "elif ranked := {",
        ),
    ),
    *changes(
        "discovery/refit/prove.py",
        TRIAL,
        (
            "a likelier fit is enough",
            "helps = likelier and self.proof(base, tried).helps()",
            "helps = likelier",
        ),
        ("a second effect is held against no effect", "            base = tried", "            pass"),
        (
            "the last trial is shown, not the last that helped",
            "shown = (kept or [fit for fit, _ in steps] or [base])[-1]",
            "shown = ([fit for fit, _ in steps] or [base])[-1]",
        ),
    ),
    *changes(
        "discovery/refit/verdict.py",
        TRIAL,
        ("intervals of one deviation", "Z_95 = 1.96", "Z_95 = 1.0"),
        (
            "the size from all samples is that of the fitted half",
            "tuple(causes_of(self.extension, self.final, ranking)) if",
            "tuple(causes_of(self.extension, self.extended.posterior, ranking)) if",
        ),
    ),
)
