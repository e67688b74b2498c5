"""Verdict of a refit: extensions that are tried, extensions that are kept, and names that are withdrawn."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from heartfit.calibration.unscented import CalibrationError
from heartfit.discovery.inference.decide import BesideProcess, Verdict
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.prove import ExtensionTrial, FittedExtension
from heartfit.discovery.refit.refit import Refit
from heartfit.discovery.refit.verdict import (
    Proof,
    TriedExtension,
    apply_proof,
    propose_extensions,
    withdraw_unhelpful,
)
from heartfit.discovery.sphere_model.cause import Cause, CurveFit, Diagnosis, Gain, UnnamedCandidate
from heartfit.observation.beat import BeatPhases
from heartfit.personalise.setting import Setting
from heartfit.results.cause_card import gain_subject, markdown_card
from heartfit.results.text import spaced_name
from tests.printed import numbers_in

PLAIN = Setting.model_validate({"element": "sphere", "estimate": ("sigma_0", "R_p")}).with_prior({})
LEAK = Cause("MitralRegurgitation", 20.0, 0.4e-4, "m^2", (0.3e-4, 0.5e-4))
OTHER = Cause("AorticStenosis", 24.0, 2e3, "Pa", (1e3, 3e3))
RANKING = {"unknown": 30.0, "AorticStenosis": 24.0, "MitralRegurgitation": 20.0}
DIAGNOSIS = Diagnosis("named", (LEAK,), (), "", (), 100, 0.8, 5.0, RANKING)
TWO, GROUP = (replace(DIAGNOSIS, verdict=verdict, mechanisms=(LEAK, OTHER)) for verdict in ("two", "group"))
NOTHING, UNKNOWN = (replace(DIAGNOSIS, verdict=verdict, mechanisms=()) for verdict in ("none", "unknown"))


def tried(diagnosis: Diagnosis) -> list[tuple[str, ...]]:
    return [extension.effects for extension in propose_extensions(diagnosis, PLAIN)]


def test_named_effects_are_tried_and_otherwise_the_best_of_the_ranking() -> None:
    assert tried(DIAGNOSIS) == tried(GROUP) == [("MitralRegurgitation",)]
    assert tried(UNKNOWN) == [("AorticStenosis",)]
    assert tried(NOTHING) == tried(replace(NOTHING, verdict="insufficient")) == []


def test_the_stronger_of_two_effects_is_tried_alone_before_both() -> None:
    assert tried(TWO) == [("AorticStenosis",), ("AorticStenosis", "MitralRegurgitation")]


def fitted(extension: Extension, evidence: float) -> Refit:
    x = extension.start(2.0)
    covariance = 0.01 * np.eye(len(x))
    return Refit(
        extension.names,
        x,
        covariance,
        extension.parameters(x),
        1.0,
        1.0,
        evidence,
        10,
        9,
        True,
        x,
        covariance,
        covariance,
    )


@dataclass
class Judge:
    """Stand-in for a trial: evidence by the number of effects, and the numbers that improve on the one before."""

    evidence: dict[int, float]
    nearer: tuple[int, ...]
    case: SimpleNamespace = field(default_factory=lambda: SimpleNamespace(both=False))

    def extended(self, extension: Extension, _: Refit) -> Refit:
        if len(extension.added) not in self.evidence:
            raise CalibrationError("no beat")
        return fitted(extension, self.evidence[len(extension.added)])

    def at(self, extension: Extension, fit: Refit) -> SimpleNamespace:
        return SimpleNamespace(extension=extension, refit=fit)

    def proof(self, _: FittedExtension, extended: FittedExtension) -> SimpleNamespace:
        return SimpleNamespace(helps=lambda: len(extended.extension.added) in self.nearer)

    def final(self, _: FittedExtension) -> None:
        """Return no size from all samples: the stand-in has no curves."""

    def fits(self, _: FittedExtension) -> tuple[CurveFit, ...]:
        """Return no chi-squared: the stand-in has no curves."""
        return ()


def climbed(judge: Judge) -> list[tuple[int, bool]]:
    base = cast("FittedExtension", judge.at(Extension(PLAIN), fitted(Extension(PLAIN), 0.0)))
    steps: Iterable[tuple[FittedExtension, bool]] = ExtensionTrial.climb(
        cast("ExtensionTrial", judge), base, propose_extensions(TWO, PLAIN)
    )
    return [(len(step.extension.added), helps) for step, helps in steps]


@pytest.mark.parametrize(
    ("evidence", "nearer", "expected"),
    [
        ({1: 9.0, 2: 12.0}, (1, 2), [(1, True), (2, True)]),
        ({1: 9.0, 2: 12.0}, (1,), [(1, True), (2, False)]),
        ({1: 9.0, 2: 8.0}, (1, 2), [(1, True), (2, False)]),
        ({1: 9.0, 2: 12.0}, (2,), [(1, False)]),
        ({1: 9.0}, (1, 2), [(1, True)]),
        ({}, (1, 2), []),
    ],
    ids=[
        "both help",
        "the second predicts no better",
        "nor is it likelier",
        "nor the first",
        "lost",
        "no beat",
    ],
)
def test_steps_are_climbed_while_each_helps_over_the_one_before(
    evidence: dict[int, float], nearer: tuple[int, ...], expected: list[tuple[int, bool]]
) -> None:
    assert climbed(Judge(evidence, nearer)) == expected


def test_names_that_do_not_help_are_withdrawn() -> None:
    assert withdraw_unhelpful(DIAGNOSIS, ("MitralRegurgitation",)) is DIAGNOSIS
    withdrawn = withdraw_unhelpful(DIAGNOSIS, ())
    assert (withdrawn.verdict, withdrawn.mechanisms, withdrawn.withdrawn) == (
        "unknown",
        (),
        ("MitralRegurgitation",),
    )
    one = withdraw_unhelpful(TWO, ("AorticStenosis",))
    assert (one.verdict, one.mechanisms, one.withdrawn) == ("named", (OTHER,), ("MitralRegurgitation",))


def test_a_group_is_kept_or_withdrawn_with_its_tried_member() -> None:
    assert withdraw_unhelpful(GROUP, ("MitralRegurgitation",)) is GROUP
    assert withdraw_unhelpful(GROUP, ()).withdrawn == ("MitralRegurgitation",)


def test_without_a_named_effect_a_trial_changes_no_verdict() -> None:
    assert withdraw_unhelpful(NOTHING, ()) is NOTHING
    assert withdraw_unhelpful(NOTHING, ("AorticStenosis",)) is NOTHING


PAIR = UnnamedCandidate((LEAK, OTHER), BesideProcess(22.7, -1.4, 1.0, 2.0, 4.0))
UNNAMED = replace(UNKNOWN, candidate=PAIR)


@pytest.mark.parametrize("verdict", ["unknown", "insufficient"])
def test_a_leading_pair_without_a_name_is_tried_as_a_named_one(verdict: Verdict) -> None:
    assert tried(replace(UNNAMED, verdict=verdict)) == tried(TWO)
    alone = replace(PAIR, causes=(LEAK,))
    assert tried(replace(UNNAMED, verdict=verdict, candidate=alone)) == [("MitralRegurgitation",)]


class Helped:
    """Stand-in for a proof with gains and traces only."""

    def gains(self) -> list[Gain]:
        return [Gain("rv_volume", "never fitted", 4e-6, 2e-6, 0.5, (0.4, 0.6))]

    def traces(self, phases: BeatPhases | None = None) -> tuple[()]:
        return ()


def judged(diagnosis: Diagnosis, kept: tuple[str, ...]) -> Diagnosis:
    *_, extension = propose_extensions(diagnosis, PLAIN)
    none, extended = fitted(Extension(PLAIN), 1.0), fitted(extension, 8.0)
    return apply_proof(
        diagnosis, TriedExtension(extension, none, extended, kept, 19), cast("Proof", Helped())
    )


def test_a_proved_diagnosis_has_the_sizes_and_evidence_of_the_refits() -> None:
    proof = judged(DIAGNOSIS, ("MitralRegurgitation",))
    assert proof.mechanisms[0].amplitude == pytest.approx(2 * 0.15e-4)
    assert proof.mechanisms[0].ln_bayes_factor == 20.0
    assert proof.simulations == 119
    assert proof.refitted is not None
    assert proof.refitted.ln_bayes_factor == 7.0
    assert set(proof.refitted.extended) == set(PLAIN.gaussian().names)
    (shown,) = [line for line in markdown_card(proof, "case").splitlines() if 7.0 in numbers_in(line)]
    assert spaced_name("MitralRegurgitation") in shown


def test_an_attempt_needs_no_search() -> None:
    judge = Judge({1: 4.0}, ())
    judge.setting, judge.baseline = PLAIN, Extension(PLAIN)
    judge.proof = lambda *_: Helped()
    trial = ExtensionTrial.attempt(
        cast("ExtensionTrial", judge), "AorticStenosis", fitted(Extension(PLAIN), 1.0)
    )
    assert [mechanism.name for mechanism in trial.refitted.extension] == ["AorticStenosis"]
    assert np.isnan(trial.refitted.extension[0].ln_bayes_factor), "a trial without a search has none"
    assert trial.refitted.ln_bayes_factor == 3.0
    assert trial.refitted.simulations == 9 + 9 + 2
    assert trial.refitted.from_all_samples == (), "no curve, no size from all samples"
    assert trial.gain[0].curve == "rv_volume"


def test_a_trial_is_no_named_effect() -> None:
    proof = judged(UNKNOWN, ())
    assert (proof.verdict, proof.mechanisms, proof.withdrawn) == ("unknown", (), ())
    assert spaced_name("AorticStenosis") in gain_subject(proof)
    assert "not named" in gain_subject(proof)
    assert gain_subject(judged(DIAGNOSIS, ("MitralRegurgitation",))) == " with mitral regurgitation"


def test_a_candidate_that_helps_gets_its_sizes_and_gains_but_no_name() -> None:
    proof = judged(UNNAMED, ("AorticStenosis", "MitralRegurgitation"))
    assert (proof.verdict, proof.mechanisms, proof.withdrawn) == ("unknown", (), ())
    assert proof.candidate is not None
    assert proof.candidate.causes[0].amplitude == pytest.approx(2 * 0.15e-4)
    assert proof.gain[0].ratio == 0.5
    assert all(spaced_name(cause.name) in gain_subject(proof) for cause in PAIR.causes)
    assert "candidate, not named" in gain_subject(proof)
