"""Mutants of the structural discrepancy: its covariance, what an earlier recording tells, and the rules beside it."""

from tests.mutations.mutant import changes

STRUCTURE = "tests/discovery/sphere_model/test_structure.py"
BASELINE = "tests/discovery/sphere_model/test_baseline.py"
WHITENING = "tests/discovery/inference/test_whitening.py"
SEARCH = "tests/discovery/inference/test_search.py"
WITHDRAWAL = "tests/discovery/sphere_model/test_withdrawal.py"

STRUCTURE_MUTANTS = (
    *changes(
        "discovery/sphere_model/structure.py",
        STRUCTURE,
        ("nothing is shrunk", "(1.0 - SHRINKAGE) * empirical", "empirical"),
        ("two recordings share all", "prior - SHARED**2 * cross.T", "prior - cross.T"),
        (
            "the earlier residual is not carried over",
            "mean = SHARED * cross.T @",
            "mean = 0.0 * cross.T @",
        ),
        ("the scale of the earlier recording is forgotten", "prior = scale**2 * self", "prior = self"),
        ("phases ignore the length of systole", "FALL * since / systole", "since / self.period"),
    ),
    *changes(
        "discovery/inference/data.py",
        WHITENING,
        ("the scale is not squared", "scale**2 * structure", "scale * structure"),
        ("structure is left out", "block_diag(*levels) + extra", "block_diag(*levels)"),
    ),
    *changes(
        "discovery/inference/search.py",
        SEARCH,
        (
            "the rules rise by what the baseline leaves",
            "rules.beside_structure(_structural_scale(context, survey.singles[0]))",
            "rules.beside_structure(_structural_scale(context, survey.baseline))",
        ),
    ),
    *changes(
        "discovery/inference/decide.py",
        BASELINE,
        ("structure raises no threshold", "if scale == 0.0:", "if scale >= 0.0:"),
    ),
    *changes(
        "discovery/sphere_model/forward_model.py",
        BASELINE,
        ("instruments change between recordings", 'stands_for == "change":', 'stands_for == "chance":'),
    ),
    *changes(
        "discovery/sphere_model/searched_recording.py",
        WITHDRAWAL,
        (
            "a misfit of structure is none",
            'return "model" if other_model else "none"',
            'return "none"',
        ),
    ),
)
"""Mutants of the structural discrepancy."""
