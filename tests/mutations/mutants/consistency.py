"""Mutants of the checks of a recording."""

from tests.mutations.mutant import changes

CONSISTENCY_MUTANTS = changes(
    "discovery/sphere_model/consistency.py",
    "tests/discovery/sphere_model/test_consistency.py",
    ("the loop runs the other way", "return -float(np.roll", "return float(np.roll"),
    ("a lag is taken for a lead", "np.roll(self.pressure, -lag)", "np.roll(self.pressure, lag)"),
    ("a clockwise loop passes", "if loop.work() <= 0.0:", "if loop.work() < -np.inf:"),
    ("the fall of the pressure is its rise", "step = 1 if rising else -1", "step = 1"),
    ("a beat that does not close passes", "if gap > LARGEST_GAP:", "if gap > 10.0:"),
    ("beats are not folded", "late = np.mod(samples.times", "late = np.minimum(samples.times"),
)  # fmt: skip
