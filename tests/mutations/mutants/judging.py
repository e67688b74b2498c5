"""Mutants of what judges a name: the halves of a recording, and the likelihood of held-out data."""

from tests.mutations.mutant import changes

HALVES = "tests/discovery/refit/test_halves.py"
HELD_OUT = "tests/discovery/sphere_model/test_held_out.py"

JUDGING_MUTANTS = (
    *changes(
        "discovery/sphere_model/held_out.py",
        HELD_OUT,
        ("every cause helps on held-out data", "return self.log_likelihood_gain() > 0.0", "return True"),
    ),
    *changes(
        "discovery/refit/target.py",
        HALVES,
        (
            "the target holds the held-out samples too",
            "return self._target(self.split.fitted)",
            "return self._target(self.split.complete())",
        ),
    ),
)
