"""Names that do not help on held-out data are withdrawn; what chose a name does not judge it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from heartfit.discovery.inference.decide import (
    DEFAULT_RULES,
    STRICT_RULES,
    BesideProcess,
    Decision,
    Effects,
    Evidences,
    Rules,
    Verdict,
    decide,
)
from heartfit.discovery.sphere_model import diagnose as module
from heartfit.discovery.sphere_model import held_out
from heartfit.discovery.sphere_model import searched_recording as searching
from heartfit.discovery.sphere_model.cause import Cause, Diagnosis, Gain, UnnamedCandidate
from heartfit.discovery.sphere_model.diagnose import conclude, predict_explanation
from heartfit.discovery.sphere_model.recording import Recording, Samples
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording

LEAK, DELAY = ("Leak",), ("Delay",)
TIMES = np.arange(25) * 0.8 / 25
VOLUME = Samples(TIMES, 100e-6 + 40e-6 * np.cos(2.0 * np.pi * TIMES / 0.8))
PRESSURE = Samples(TIMES, 8e3 - 7e3 * np.cos(2.0 * np.pi * TIMES / 0.8))
RAISED = {"legs raised": cast("Recording", None)}


@dataclass(frozen=True)
class Gained:
    """Stand-in for a held-out prediction with this gain in ln likelihood."""

    gain: float

    def helps(self) -> bool:
        return self.gain > 0.0

    def log_likelihood_gain(self) -> float:
        return self.gain

    def gains(self) -> tuple[()]:
        return ()


@dataclass
class Searched:
    """Stand-in for a searched recording: its verdict, and the ln Bayes factors of the named effects, the best first."""

    verdict: Verdict
    factors: Mapping[Effects, float]
    rules: Rules = DEFAULT_RULES
    unseen: Recording | None = None
    discrepancy: float = 6.0
    scale: float = 0.0
    library: Mapping[str, str] = field(default_factory=lambda: {"Leak": "leak", "Delay": "delay"})
    data: SimpleNamespace = field(default_factory=lambda: SimpleNamespace(values=np.zeros(3)))
    model: SimpleNamespace = field(
        default_factory=lambda: SimpleNamespace(
            simulations=7, nominal=SimpleNamespace(stands_for="people"), base=range(23)
        )
    )
    recording: SimpleNamespace = field(
        default_factory=lambda: SimpleNamespace(
            period=0.8,
            curves={"lv_volume": VOLUME, "lv_pressure": PRESSURE},
            searched=("lv_volume", "lv_pressure"),
            unsearched={},
            noise={},
        )
    )

    @property
    def explanations(self) -> tuple[Effects, ...]:
        return tuple(self.factors)

    @property
    def findings(self) -> SimpleNamespace:
        at = {
            effects: SimpleNamespace(fit=SimpleNamespace(x=f"fit of {effects}")) for effects in self.factors
        }
        baseline = SimpleNamespace(fit=SimpleNamespace(x="fit of none"))
        return SimpleNamespace(
            decision=Decision(self.verdict),
            log_bayes_factor=self.factors.__getitem__,
            explanation=at.get,
            survey=SimpleNamespace(baseline=baseline, singles=list(at.values())),
            evidences=SimpleNamespace(baseline=0.0, discrepancy=self.discrepancy),
            structural_scale=self.scale,
            margin=None,
        )

    @property
    def unnamed(self) -> Effects:
        return SearchedRecording.unnamed.fget(self)  # type: ignore[attr-defined]

    def candidate(self) -> UnnamedCandidate | None:
        return SearchedRecording.candidate(cast("SearchedRecording", self))

    def sizes_from_all_samples(self, named: Sequence[Effects]) -> tuple[Cause, ...]:
        return tuple(
            replace(self.cause(effects, name), amplitude=2.0) for effects in named for name in effects
        )

    def cause(self, effects: Effects, name: str) -> Cause:
        return Cause(name, self.factors[effects], 1.0, "1", (0.5, 1.5))

    @property
    def verdict_without_name(self) -> Verdict:
        return SearchedRecording.verdict_without_name.fget(self)  # type: ignore[attr-defined]

    @property
    def nothing(self) -> Verdict:
        return SearchedRecording.nothing.fget(self)  # type: ignore[attr-defined]

    @property
    def unseen_problem(self) -> str | None:
        return None if self.unseen is None else f"data of {self.unseen}"

    def problem(self, recording: Recording) -> SimpleNamespace:
        return SimpleNamespace(data=f"data of {recording}")

    def far_parameters(self, effects: Effects) -> tuple[str, ...]:
        return (f"far beside {' and '.join(effects)}",)

    def scale_notes(self) -> tuple[()]:
        return ()

    def changes(self, effects: Effects) -> tuple[()]:
        return ()

    def ranking(self) -> dict[str, float]:
        return {}

    phases: None = field(default=None, init=False)

    def traces(self, explained: object) -> tuple[()]:
        return ()

    def tried(self) -> tuple[()]:
        return ()


def concluded(
    monkeypatch: pytest.MonkeyPatch,
    case: Searched,
    gains: Mapping[Effects, tuple[float, ...]],
    conditions: Mapping[str, Recording] = RAISED,
) -> Diagnosis:
    """The conclusion where each effect has these gains on held-out data."""
    monkeypatch.setattr(module, "next_measurement", lambda *_: "the flow")
    monkeypatch.setattr(
        module, "predict_explanation", lambda _, effects, __: list(map(Gained, gains[effects]))
    )
    return conclude(cast("SearchedRecording", case), conditions)


def names(diagnosis: Diagnosis) -> tuple[str, ...]:
    return tuple(cause.name for cause in diagnosis.mechanisms)


@pytest.mark.parametrize("gains", [(-0.1,), (2.0, -0.1)], ids=["in-the-only-test", "in-one-of-two"])
def test_a_name_that_makes_held_out_data_less_likely_is_withdrawn(
    monkeypatch: pytest.MonkeyPatch, gains: tuple[float, ...]
) -> None:
    diagnosis = concluded(monkeypatch, Searched("named", {LEAK: 12.0}), {LEAK: gains})
    assert (diagnosis.verdict, names(diagnosis), diagnosis.withdrawn) == ("unknown", (), LEAK)


@pytest.mark.parametrize(
    ("discrepancy", "searched", "verdict"),
    [
        (5.1, ("lv_volume", "lv_pressure"), "unknown"),
        (4.9, ("lv_volume", "lv_pressure"), "none"),
        (4.9, ("lv_volume",), "insufficient"),
    ],
)
def test_a_withdrawn_name_leaves_what_a_discrepancy_shows(
    monkeypatch: pytest.MonkeyPatch, discrepancy: float, searched: tuple[str, ...], verdict: Verdict
) -> None:
    case = Searched("named", {LEAK: 12.0}, discrepancy=discrepancy)
    case.recording.searched = searched
    diagnosis = concluded(monkeypatch, case, {LEAK: (-0.1,)})
    assert (diagnosis.verdict, names(diagnosis), diagnosis.withdrawn) == (verdict, (), LEAK)


@pytest.mark.parametrize(
    ("scale", "stands_for", "verdict"),
    [(0.0, "people", "none"), (0.5, "people", "model"), (0.5, "change", "none")],
)
def test_a_misfit_that_structure_explains_is_one_of_the_model(
    monkeypatch: pytest.MonkeyPatch, scale: float, stands_for: str, verdict: Verdict
) -> None:
    case = Searched("named", {LEAK: 12.0}, discrepancy=4.9, scale=scale)
    case.model.nominal.stands_for = stands_for
    assert concluded(monkeypatch, case, {LEAK: (-0.1,)}).verdict == verdict


def test_a_name_that_helps_in_every_test_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    diagnosis = concluded(monkeypatch, Searched("named", {LEAK: 12.0}), {LEAK: (2.0, 0.1)})
    assert (diagnosis.verdict, names(diagnosis), diagnosis.withdrawn) == ("named", LEAK, ())
    assert [cause.amplitude for cause in diagnosis.from_all_samples] == [2.0]
    assert [cause.amplitude for cause in diagnosis.mechanisms] == [1.0]
    assert [cause.amplitude for cause in diagnosis.named] == [2.0]
    assert diagnosis.warnings == ("far beside Leak",)


@pytest.mark.parametrize(("gain", "kept"), [(3.9, DELAY), (2.5, DELAY + LEAK), (0.5, LEAK + DELAY)])
def test_another_condition_adds_its_evidence_to_that_of_each_member_of_a_group(
    monkeypatch: pytest.MonkeyPatch, gain: float, kept: tuple[str, ...]
) -> None:
    """Evidences of 12 and 11, and gains of 0.1 and this one: beyond a difference of 3 one is named alone."""
    group = Searched("group", {LEAK: 12.0, DELAY: 11.0})
    diagnosis = concluded(monkeypatch, group, {LEAK: (0.1,), DELAY: (gain + 0.1 + 0.11,)})
    assert names(diagnosis) == kept
    assert diagnosis.verdict == ("named" if len(kept) == 1 else "group")


def test_a_name_whose_beat_fails_on_held_out_data_is_withdrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "next_measurement", lambda *_: "the flow")
    monkeypatch.setattr(module, "predict_explanation", lambda *_: [Gained(2.0), None])
    case = Searched("named", {LEAK: 12.0})
    diagnosis = conclude(cast("SearchedRecording", case), RAISED)
    assert (diagnosis.verdict, diagnosis.withdrawn) == ("unknown", LEAK)


def test_half_of_a_recording_withdraws_a_group_with_its_best_member(monkeypatch: pytest.MonkeyPatch) -> None:
    group = Searched("group", {LEAK: 12.0, DELAY: 11.0})
    diagnosis = concluded(monkeypatch, group, {LEAK: (-1.0,)}, {})
    assert (diagnosis.verdict, diagnosis.withdrawn) == ("unknown", LEAK + DELAY)


@dataclass
class Unnamed(Searched):
    """A searched recording whose pair leads by 8 over the better of its effects and lies 1.5 below the process."""

    pair: float = 22.5

    @property
    def explanations(self) -> tuple[Effects, ...]:
        return ()

    @property
    def findings(self) -> SimpleNamespace:
        both = LEAK + DELAY
        singles, pairs = {LEAK: self.pair - 8.0, DELAY: -9.0}, {both: self.pair}
        left = {LEAK: self.pair - 7.0, both: self.pair + 1.0}
        evidences = Evidences(0.0, singles, self.pair + 1.5, left, pairs)
        known = {**vars(super().findings), "evidences": evidences, "decision": decide(evidences)}
        return SimpleNamespace(**known)


@pytest.mark.parametrize(
    ("searched", "verdict"), [(("lv_volume", "lv_pressure"), "unknown"), (("lv_volume",), "insufficient")]
)
def test_a_leading_pair_without_a_name_is_a_candidate_and_judged(
    monkeypatch: pytest.MonkeyPatch, searched: tuple[str, ...], verdict: Verdict
) -> None:
    both = LEAK + DELAY
    case = Unnamed("unknown", {both: 22.5})
    case.recording.searched = searched
    case.verdict = SearchedRecording.verdict.func(case)  # type: ignore[attr-defined]
    judged = Gain("lv_volume", "the other half", 2.0, 1.0, 0.5, (0.4, 0.6))
    monkeypatch.setattr(Gained, "gains", lambda _: (judged,))
    diagnosis = concluded(monkeypatch, case, {both: (5.0,)})
    assert (diagnosis.verdict, names(diagnosis), diagnosis.gain) == (verdict, (), (judged,))
    assert diagnosis.candidate is not None
    assert tuple(cause.name for cause in diagnosis.candidate.causes) == both
    assert diagnosis.candidate.beside_process == BesideProcess(22.5, -1.5, 1.0, 2.0, 4.0)


def test_what_is_named_or_not_detected_is_no_candidate(monkeypatch: pytest.MonkeyPatch) -> None:
    both = LEAK + DELAY
    assert Unnamed("unknown", {both: 4.9}, pair=4.9).unnamed == ()
    assert Unnamed("unknown", {both: 5.0}, pair=5.0).unnamed == both
    named = concluded(monkeypatch, Searched("named", {LEAK: 12.0}), {LEAK: (2.0,)})
    assert named.candidate is None


@pytest.fixture
def judges(monkeypatch: pytest.MonkeyPatch) -> None:
    """Predictions that return their kind and the data that they judge by."""

    def effects(extension: partial[object], *fits: str) -> tuple[object, ...]:
        return (extension.keywords["effects"], *fits)

    monkeypatch.setattr(held_out, "predict_unseen", lambda data, *fits: ("unseen", data, effects(*fits)))
    monkeypatch.setattr(
        held_out, "predict_condition", lambda name, _, data, *fits: (name, data, effects(*fits))
    )


@pytest.mark.usefixtures("judges")
def test_samples_that_the_search_has_not_seen_judge_and_other_conditions_do() -> None:
    fits = (("leak",), "fit of none", "fit of ('Leak',)")
    case = Searched("named", {LEAK: 12.0})
    raised = cast("Mapping[str, Recording]", {"legs raised": "raised legs"})

    def judged(conditions: Mapping[str, Recording]) -> list[object]:
        return list(predict_explanation(cast("SearchedRecording", case), LEAK, conditions))

    assert judged({}) == [], "a recording too short for two halves judges nothing"
    assert judged(raised) == [("legs raised", "data of raised legs", fits)]
    case.unseen = cast("Recording", "the other half")
    assert judged({}) == [("unseen", "data of the other half", fits)]
    assert judged(raised) == [
        ("legs raised", "data of raised legs", fits),
        ("unseen", "data of the other half", fits),
    ]


@pytest.mark.parametrize(
    ("curves", "rules", "threshold"),
    [
        ({"lv_volume": VOLUME, "lv_pressure": PRESSURE}, DEFAULT_RULES, 5.0),
        ({"lv_volume": VOLUME}, DEFAULT_RULES, 10.0),
        ({"lv_volume": VOLUME}, Rules(detected=12.0), 12.0),
        ({"lv_volume": VOLUME, "lv_pressure": PRESSURE}, STRICT_RULES, 10.0),
    ],
    ids=["both", "volume", "volume-strict", "both-strict"],
)
def test_a_volume_alone_needs_more_evidence(
    monkeypatch: pytest.MonkeyPatch, curves: Mapping[str, Samples], rules: Rules, threshold: float
) -> None:
    applied: list[Rules] = []
    monkeypatch.setattr(searching, "candidates", lambda _: {})

    def search(*arguments: object) -> SimpleNamespace:
        applied.append(cast("Rules", arguments[-1]))
        return SimpleNamespace(rules=arguments[-1])

    monkeypatch.setattr(searching, "search", search)
    SearchedRecording.search(Recording(0.8, curves), rules=rules)
    assert [rule.detected for rule in applied] == [threshold]
