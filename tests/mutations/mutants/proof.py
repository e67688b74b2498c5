"""Mutants of the refit in 3-D and of the proof by what it leaves unseen."""

from tests.mutations.mutant import changes

PROOF_MUTANTS = (
    *changes(
        "discovery/refit/verdict.py",
        "tests/discovery/refit/test_unseen.py::test_an_extension_helps_if_all_unseen_curves_together_come_nearer",
        (
            "every extension helps on unseen data",
            "return self._held_out_misfit(self.extended) < self._held_out_misfit(self.baseline)",
            "return True",
        ),
    ),
)
