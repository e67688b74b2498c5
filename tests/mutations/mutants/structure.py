"""Mutants of the structural discrepancy, of functions inside the equations, and of the rules beside them."""

from tests.mutations.mutant import changes

STRUCTURE = "tests/discovery/sphere_model/test_structure.py"
PROBLEM = "tests/discovery/sphere_model/test_problem.py"
EARLIER = "tests/discovery/sphere_model/test_earlier.py"
PLACES = "tests/places/test_places.py"
WHITENING = "tests/discovery/inference/test_whitening.py"
SEARCH = "tests/discovery/inference/test_search.py"
WITHDRAWAL = "tests/discovery/sphere_model/test_withdrawal.py"

STRUCTURE_MUTANTS = (
    *changes(
        "discovery/sphere_model/structure.py",
        STRUCTURE,
        ("nothing is shrunk", "(1.0 - SHRINKAGE) * empirical", "empirical"),
    ),
    *changes(
        "discovery/sphere_model/landmarks.py",
        STRUCTURE,
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
        PROBLEM,
        ("structure raises no threshold", "if scale == 0.0:", "if scale >= 0.0:"),
    ),
    *changes(
        "discovery/inference/decide.py",
        EARLIER,
        (
            "a change needs what structure asks for",
            "CHANGE_RULES = Rules(detected_beside_structure=5.0, ",
            "CHANGE_RULES = Rules(",
        ),
    ),
    *changes(
        "discovery/sphere_model/earlier.py",
        EARLIER,
        ("the functions are forgotten", "replace(placed, stands_for", "replace(heart, stands_for"),
        (
            "functions keep their course at another rate",
            "place.function.at(times)",
            "place.function.at(np.arange(SAMPLES) * place.function.period / SAMPLES)",
        ),
        (
            "a change may have any level of noise",
            "levels = self.levels.get(block.curve, block.noise.levels)",
            "levels = block.noise.levels",
        ),
        (
            "the covariance is that of the parameters",
            "model.jacobian(at, predicted, BASE)",
            "model.jacobian(at, predicted)[:, :BASE]",
        ),
    ),
    *changes(
        "places/periodic.py",
        PLACES,
        ("the mean varies as a wave", "np.where(k > 0, 2.0, 1.0)", "2.0"),
        ("sines are cosines", "np.cos(angle), np.sin(angle)]", "np.cos(angle), np.cos(angle)]"),
    ),
    *changes(
        "places/wall.py",
        PLACES,
        ("the right ventricle is pressed, too", ' if ventricle == "lv" else Load()', ""),
    ),
    *changes(
        "discovery/sphere_model/forward_model.py",
        EARLIER,
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
