"""Mutants of the search with the strain of the wall."""

from tests.mutations.mutant import changes

WALL = "tests/discovery/wall_model"

WALL_MUTANTS = (
    *changes(
        "discovery/wall_model/hypotheses.py",
        f"{WALL}/test_forward_model.py",
        ("regional effects tried at one angle", "AROUND = 6", "AROUND = 1"),
    ),
    *changes(
        "discovery/wall_model/wall_data.py",
        f"{WALL}/test_wall_data.py",
        (
            "gains of registration forgotten",
            "        structure[-len(tied) :, -len(tied) :] = tied\n",
            "",
        ),
        (
            "the right volume has no gain",
            "GAIN_SD * (volumes - volumes[0])",
            "0.0 * (volumes - volumes[0])",
        ),
        (
            "measured strain not over its gain",
            "self.noise.corrected(regional_curves(",
            "dict(regional_curves(",
        ),
    ),
    *changes(
        "discovery/wall_model/territory.py",
        f"{WALL}/test_territory.py",
        (
            "fits count alike",
            "softmax([fitted.log_evidence for fitted in own])",
            "softmax([0.0 for fitted in own])",
        ),
        ("segments of any weight", "AFFECTED = 0.5", "AFFECTED = 0.0"),
    ),
    *changes(
        "discovery/wall_model/unknowns.py",
        f"{WALL}/test_forward_model.py",
        ("variation of the wall inverted", "1.0 - np.exp(CONTRACTILITY_SD", "1.0 - np.exp(-CONTRACTILITY_SD"),
    ),
    *changes(
        "discovery/wall_model/search.py",
        f"{WALL}/test_search.py",
        ("effects fitted from the baseline alone", "best[:REFITTED]", "best[:0]"),
        ("any gain named", "RULES = STRICT_RULES", "RULES = type(STRICT_RULES)(detected=-50.0)"),
        ("fit without slopes given up", "(x + start) / 2.0)", "start)"),
        ("slopes always renewed", "CONVERGED = 1.5", "CONVERGED = 0.0"),
        ("secants between time steps", "else (longer, before)", "else (longer, base.fit.predicted)"),
    ),
    *changes(
        "discovery/inference/data.py",
        f"{WALL}/test_wall_data.py",
        ("levels of the independent blocks lost", "[*best[:-1], *levels]", "[*levels]"),
    ),
    *changes(
        "discovery/wall_model/forward_model.py",
        f"{WALL}/test_forward_model.py",
        (
            "an atrium without blood at the start",
            "if self.state.atria is not None or chamber_table(heart.mechanisms) is not None:",
            "if self.state.atria is not None:",
        ),
        (
            "measured responses forgotten",
            "run(start=start, responses=near.responses)",
            "run(start=start)",
        ),
    ),
    *changes(
        "discovery/inference/predicted_evidence.py",
        "tests/discovery/inference/test_predicted_evidence.py",
        ("detection limit without Occam's factor", "added - 0.5 * np.log(self.variance)", "added"),
        ("detection limit of one sign", "[-1] * np.log(2.0)", "[-1] * np.log(1.0)"),
    ),
    *changes(
        "heart/circulation/elements.py",
        "tests/heart/circulation/test_valves.py",
        ("valves in series lose by the smaller alone", ".with_narrowing(self.area**-2)", ""),
    ),
    *changes(
        "heart/simulation.py",
        "tests/heart/test_simulation.py",
        ("start of a beat ignored", "run.relaxed() if start is None else start", "run.relaxed()"),
        ("guesses of the responses ignored", "before, self.guesses)", "before)"),
    ),
    *changes(
        "results/wall_summary.py",
        "tests/results/test_wall_card.py",
        ("named effects among the unseen", "if name not in findings.decision.effects", "if True"),
    ),
)
