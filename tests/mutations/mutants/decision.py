"""Mutants of the decision: thresholds and verdicts from differences of ln evidence."""

from tests.mutations.mutant import changes

DECISION_MUTANTS = (
    *changes(
        "discovery/inference/decide.py",
        "tests/discovery/inference/test_decide.py",
        (
            "the threshold in 3-D is 1",
            "CENTRED_RULES = Rules(detected=7.0)",
            "CENTRED_RULES = Rules(detected=1.0)",
        ),
        ("strict rules are the default", "STRICT_RULES = Rules(detected=10.0)", "STRICT_RULES = Rules()"),
        (
            "only effects of the library are detected",
            "return max(evidences.singles[evidences.single], evidences.discrepancy) - evidences.baseline",
            "return evidences.singles[evidences.single] - evidences.baseline",
        ),
        (
            "an effect no better than a discrepancy is named",
            "return self.over >= self.required and self.left <= self.allowed",
            "return self.left <= self.allowed",
        ),
        (
            "a strong effect may leave anything",
            "rules.strong_share * gain if over >= rules.strong",
            "left if over >= rules.strong",
        ),
        ("a pair needs no gain", "best >= rules.second", "best >= 0.0"),
        (
            "a pair may be worse than the process",
            "if not is_explained(evidences, leading, rules):",
            "if leading in evidences.singles and not is_explained(evidences, leading, rules):",
        ),
        (
            "the best single effect stands for a pair",
            "leading = leading_effects(evidences, rules)",
            "leading = evidences.single",
        ),
        (
            "no two effects are alike",
            "table[best] - table[effects] < rules.group",
            "table[best] < table[effects]",
        ),
    ),
)
