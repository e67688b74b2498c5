"""Mutants of the checks of a recording."""

from tests.mutations.mutant import changes

TESTS = "tests/discovery/sphere_model/test_consistency.py"

CONSISTENCY_MUTANTS = (
    *changes(
        "discovery/sphere_model/consistency.py",
        TESTS,
        ("the loop runs the other way", "return -float(np.roll", "return float(np.roll"),
        ("a lag is taken for a lead", "np.roll(self.pressure, -lag)", "np.roll(self.pressure, lag)"),
        ("a clockwise loop passes", "if loop.work() <= 0.0:", "if loop.work() < -np.inf:"),
        ("the fall of the pressure is its rise", "step = 1 if rising else -1", "step = 1"),
        ("a beat that does not close passes", "if gap > LARGEST_GAP:", "if gap > 10.0:"),
    ),
    *changes(
        "discovery/sphere_model/samples.py",
        TESTS,
        ("beats are not folded", "np.mod(samples.times, period)", "np.minimum(samples.times, period)"),
        ("rounding makes a bin of its own", "< ROUNDING * length", "< 0.0"),
    ),
)
