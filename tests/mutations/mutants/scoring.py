"""Mutants of the scores of planted hearts: what counts as right, as covered and as detectable."""

from tests.mutations.mutant import changes

SCORING_MUTANTS = changes(
    "synthetic/scoring.py",
    "tests/synthetic/test_scoring.py",
    ("any name is right", "return self.named and self.finding.names == self.truth", "return self.named"),
    (
        "a group is right without the planted effect",
        'verdict == "group" and self.truth <= self.finding.names',
        'verdict == "group"',
    ),
    (
        "an interval covers what lies below it",
        "return low <= effect.amplitude <= high",
        "return effect.amplitude <= high",
    ),
    (
        "sizes are compared from zero",
        "(self._cause_of(effect).amplitude - effect.off) / (effect.amplitude - effect.off)",
        "self._cause_of(effect).amplitude / effect.amplitude",
    ),
    (
        "unlikely counts are likely",
        'worse = "greater" if at_most else "less"',
        'worse = "less" if at_most else "greater"',
    ),
    (
        "an effect is as detectable as its opposite",
        "float(np.sign(effect.amplitude - effect.off))",
        "float(np.sign(abs(effect.amplitude)))",
    ),
    (
        "too few data are a detection",
        'SILENT = ("none", "model", "insufficient", REFUSED)',
        'SILENT = ("none", "model", REFUSED)',
    ),
)
