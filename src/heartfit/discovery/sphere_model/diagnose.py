"""The diagnosis of a recording: search on the sphere, held-out tests, and the next measurement."""

from collections.abc import Collection, Mapping, Sequence
from functools import partial

from heartfit.discovery.inference.decide import CHANGE_RULES, DEFAULT_RULES, Effects, Rules, Verdict
from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.discovery.sphere_model.consistency import implausible
from heartfit.discovery.sphere_model.earlier import EarlierHeart
from heartfit.discovery.sphere_model.forward_model import hypothesis
from heartfit.discovery.sphere_model.held_out import HeldOutPrediction, predict_extension
from heartfit.discovery.sphere_model.limits import RECORD_PRESSURE, next_measurement
from heartfit.discovery.sphere_model.nominal_heart import NominalHeart
from heartfit.discovery.sphere_model.problem import DiscrepancyPrior
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording
from heartfit.discovery.sphere_model.strokes import Strokes
from heartfit.discovery.sphere_model.unknown_place import locate
from heartfit.places import Place


def diagnose(
    recording: Recording,
    conditions: Mapping[str, Recording] | None = None,
    nominal: NominalHeart | None = None,
    rules: Rules = DEFAULT_RULES,
    unseen: Recording | None = None,
    structure: DiscrepancyPrior | None = None,
    places: Sequence[type[Place]] = (),
    left_out: Collection[str] = (),
) -> Diagnosis:
    """Diagnose the effects that the model of the heart lacks to explain the recording; see ``heartfit.diagnose``.

    This function of the workflow trusts the model by default, the public one does not.

    conditions: recordings of the same heart under other loading, by name; only the loading is fitted to them. nominal:
    a sphere that was fitted to a beat of the 3-D model; the adult's, scaled to the recorded size, if None. unseen:
    samples of the same beat, which judge a name and do not choose it. structure: of the discrepancy between the sphere
    and the source of the recording; None where the model is trusted. places: where an unknown effect may act,
    of a trusted model. left_out: mechanisms of the library that are not tried.

    About the adult's trusted model the volume of the right ventricle is searched, too, where it was recorded together
    with a left pressure. Without unseen samples and conditions the search sees half of the recording, and the other
    half judges. Raises InputError where the nominal heart does not beat, and for a loop of pressure and volume that
    runs clockwise.
    """
    warnings = implausible(recording)
    conditions = conditions or {}
    if nominal is None and structure is None:
        recording = recording.with_both_ventricles()
        conditions = {name: one.with_both_ventricles(balanced=False) for name, one in conditions.items()}
    if unseen is None and not conditions:
        recording, unseen = recording.halves()
    case = SearchedRecording.search(recording, nominal, rules, unseen, structure, left_out)
    return locate(conclude(case, conditions, warnings), case, conditions, places)


def diagnose_change(after: Recording, before: Recording) -> Diagnosis:
    """Diagnose what has changed between two recordings of one heart: parameters, or a mechanism.

    The sphere is fitted to the earlier recording with free functions inside its equations, which the later one keeps up
    to small changes. Raises InputError as :func:`diagnose` does.
    """
    earlier = EarlierHeart.from_recording(before)
    nominal = earlier.at_period(after.period)
    return diagnose(after, nominal=nominal, rules=CHANGE_RULES, structure=earlier)


def conclude(
    case: SearchedRecording, conditions: Mapping[str, Recording], warnings: tuple[str, ...] = ()
) -> Diagnosis:
    """The diagnosis with the names that help on held-out data; a name whose beat fails there does not."""
    tried = predict_held_out(case, conditions)
    helping = [effects for effects, tests in tried.items() if all(test and test.helps() for test in tests)]
    scores = {
        effects: case.findings.log_bayes_factor(effects) + _condition_gain(tried[effects], conditions)
        for effects in helping
    }
    kept = near_best(scores, case.rules.group)
    verdict = _verdict(case, kept)
    best = next(iter([*kept, *tried]), case.unnamed)
    judged = tried.get(best) or (predict_explanation(case, best, conditions) if best else [])
    return Diagnosis(
        verdict,
        tuple(case.cause(effects, name) for effects in kept for name in effects),
        tuple(kept[1:]) if case.verdict == "group" else case.findings.decision.alternatives,
        _next_measurement(case, verdict, kept),
        tuple(gain for test in judged if test for gain in test.gains()),
        case.model.simulations,
        case.recording.period,
        case.rules.detected,
        case.ranking(),
        tuple(name for effects in tried if effects not in helping for name in effects),
        case.traces(case.findings.explanation(best)),
        unsearched={
            name: why for name, why in case.recording.unsearched.items() if name in case.recording.curves
        },
        phases=case.phases,
        tried=case.tried(),
        samples=case.data.values.size,
        from_all_samples=case.sizes_from_all_samples(kept),
        warnings=(*warnings, *case.far_parameters(best), *case.scale_notes()),
        structural_scale=case.findings.structural_scale,
        changes=case.changes(best),
        strokes=Strokes.from_recording(case.recording),
        read_twice={name: noise.deviation for name, noise in case.recording.noise.items()},
        free_parameters=len(case.model.base),
        candidate=case.candidate(),
        margin=case.findings.margin,
    )


def predict_held_out(
    case: SearchedRecording, conditions: Mapping[str, Recording]
) -> dict[Effects, list[HeldOutPrediction | None]]:
    """Predictions of other conditions by each explanation.

    Without conditions the other half of the recording judges, and the best explanation stands for its group: half of
    the data cannot tell effects apart that the first half cannot.
    """
    if conditions:
        return {effects: predict_explanation(case, effects, conditions) for effects in case.explanations}
    best = predict_explanation(case, case.explanations[0], {}) if case.explanations else []
    return dict.fromkeys(case.explanations, best)


def predict_explanation(
    case: SearchedRecording, effects: Effects, conditions: Mapping[str, Recording]
) -> list[HeldOutPrediction | None]:
    """Predictions of conditions and unseen samples without and with the effects; None where a beat fails.

    Empty for a recording too short for two halves, without another condition: then nothing judges.
    """
    added = tuple(case.library[name] for name in effects)
    fitted = case.findings.explanation(effects).fit.x
    return predict_extension(case, partial(hypothesis, effects=added), fitted, conditions)


def _condition_gain(tests: Sequence[HeldOutPrediction | None], conditions: Mapping[str, Recording]) -> float:
    """ln likelihood that other conditions add; the other half of the same recording judges and does not choose."""
    return sum(test.log_likelihood_gain() for test in tests if test) if conditions else 0.0


def near_best(score: Mapping[Effects, float], within: float) -> list[Effects]:
    """The effects whose score lies ``within`` that of the best, the best first."""
    least = max(score.values(), default=0.0) - within
    return sorted(
        (effects for effects in score if score[effects] > least), key=lambda effects: -score[effects]
    )


def _verdict(case: SearchedRecording, kept: Sequence[Effects]) -> Verdict:
    """The verdict after the judgement; without a kept name an effect is missing only where a discrepancy shows it.

    A name that the held-out data refute has shown nothing but a chance of the half that chose it.
    """
    if not case.explanations:
        return case.verdict
    if not kept:
        return case.verdict_without_name
    return "named" if case.verdict == "group" and len(kept) == 1 else case.verdict


def _next_measurement(case: SearchedRecording, verdict: Verdict, kept: Sequence[Effects]) -> str:
    """The measurement that decides between the members of a group, or between the two best effects if unknown."""
    if "lv_pressure" not in case.recording.curves:
        return RECORD_PRESSURE
    if verdict == "group":
        explanations = [case.findings.explanation(effects) for effects in kept[:3]]
    elif verdict == "unknown":
        explanations = list(case.findings.survey.singles[:2])
    else:
        return ""
    if len(explanations) < 2:
        return ""
    return next_measurement(case.model.nominal, case.data, case.library, explanations)
