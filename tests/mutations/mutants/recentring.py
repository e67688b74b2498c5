"""Mutants of the sphere that is centred on a 3-D beat, and of its self-test."""

from tests.mutations.mutant import changes

RECENTRING_MUTANTS = changes(
    "discovery/sphere_model/recentred.py",
    "tests/discovery/sphere_model/test_recentring.py",
    (
        "recentring ignores the 3-D beat",
        "nominal = fit_nominal_heart(heart, first, followed)",
        "nominal = ADULT",
    ),
    (
        "the search leaves the centred sphere",
        "search(nominal=nominal, rules=applied",
        "search(nominal=ADULT, rules=applied",
    ),
    (
        "the sphere starts without the heart's parameters",
        "data, nominal = _data(recording), _start(heart, recording)",
        "data, nominal = _data(recording), ADULT.scaled_to(recording)",
    ),
    (
        "a sphere's muscle is as strong as a mesh's",
        '{"sigma_0": SPHERE_CONTRACTILITY_RATIO * heart',
        '{"sigma_0": heart',
    ),
    (
        "a sphere follows on average",
        "left = float(np.sqrt(np.mean(error**2)))",
        "left = abs(float(np.mean(error)))",
    ),
    (
        "the self-test searches the beat of the centre",
        "[beat for beat in others if beat]",
        "[beat for beat in beats if beat]",
    ),
    (
        "a failed self-test changes nothing",
        "applied = rules if result is None or result <= SELF_TEST_LIMIT else STRICT_RULES",
        "applied = rules",
    ),
    (
        "a self-test without noise",
        "noise: Floats = np.linalg.cholesky(instrument)",
        "noise: Floats = 0.0 * np.linalg.cholesky(instrument)",
    ),
    (
        "the judging half is lost on the way",
        "unseen=unseen, places=places",
        "places=places",
    ),
)
