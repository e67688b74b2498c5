"""Mutants of the withdrawal of names that do not help, on the sphere and after the refit in 3-D."""

from tests.mutations.mutant import changes

WITHDRAWAL = "tests/discovery/sphere_model/test_withdrawal.py"
VERDICT = "tests/discovery/refit/test_verdict.py"

WITHDRAWAL_MUTANTS = (
    *changes(
        "discovery/sphere_model/diagnose.py",
        WITHDRAWAL,
        (
            "one test in which a name helps suffices",
            "if all(test and test.helps()",
            "if any(test and test.helps()",
        ),
        (
            "the verdict names what was withdrawn",
            "        return case.verdict_without_name",
            "        return case.verdict",
        ),
        (
            "a withdrawn name stays among the mechanisms",
            "tuple(case.cause(effects, name) for effects in kept for",
            "tuple(case.cause(effects, name) for effects in case.explanations for",
        ),
        (
            "withdrawn names are not reported",
            "for effects in tried if effects not in helping for",
            "for effects in () if effects not in helping for",
        ),
        (
            "another condition adds no evidence",
            "sum(test.log_likelihood_gain() for test in tests if test) if conditions else 0.0",
            "0.0",
        ),
        (
            "nothing judges a candidate",
            "(predict_explanation(case, best, conditions) if best else [])",
            "[]",
        ),
    ),
    *changes(
        "discovery/sphere_model/held_out.py",
        WITHDRAWAL,
        ("unseen samples do not judge", "if case.unseen_problem is not None:", "if False:"),
    ),
    *changes(
        "discovery/sphere_model/searched_recording.py",
        WITHDRAWAL,
        (
            "a refuted name always leaves something unknown",
            "if evidences.discrepancy - evidences.baseline >= self.rules.detected:",
            "if evidences.baseline < np.inf:",
        ),
        (
            "what is not detected is a candidate",
            "return leading if self.findings.log_bayes_factor(leading) >= self.rules.detected else ()",
            "return leading",
        ),
        (
            "a volume alone needs no more evidence",
            "VOLUME_ONLY_THRESHOLD = 10.0",
            "VOLUME_ONLY_THRESHOLD = 5.0",
        ),
    ),
    *changes(
        "discovery/refit/verdict.py",
        VERDICT,
        (
            "a candidate is not refitted",
            "for cause in diagnosis.mechanisms or _candidates(diagnosis)]",
            "for cause in diagnosis.mechanisms]",
        ),
        (
            "a name that the refit withdraws stays",
            "verdict=verdict, mechanisms=left,",
            "verdict=verdict, mechanisms=diagnosis.mechanisms,",
        ),
        (
            "the verdict survives the withdrawal in 3-D",
            'Verdict = "named" if left else "unknown"',
            "Verdict = diagnosis.verdict",
        ),
        (
            "a group is kept in any case",
            '(diagnosis.verdict == "group" and kept)',
            'diagnosis.verdict == "group"',
        ),
    ),
)
