"""From a recording to the cause of what a simulation of the heart gets wrong; see docs/discovery.md."""

from collections.abc import Mapping, Sequence

from heartfit.diagnosis.case import Case
from heartfit.diagnosis.cause import Diagnosis, Verdict
from heartfit.diagnosis.centre import Centre
from heartfit.diagnosis.held_out import Predicted, in_condition, on_half
from heartfit.diagnosis.next_measurement import PRESSURE, next_measurement
from heartfit.diagnosis.record import data_of
from heartfit.diagnosis.recording import UNSEARCHED, Recording
from heartfit.diagnosis.trace import traces
from heartfit.discovery.decide import Effects
from heartfit.discovery.rules import RULES, Rules


def diagnose(
    recording: Recording,
    conditions: Mapping[str, Recording] | None = None,
    centre: Centre | None = None,
    rules: Rules = RULES,
) -> Diagnosis:
    """What the model of the heart lacks to explain the recording.

    conditions: the same heart under other loading, by name; never fitted but for the loading. centre: a sphere that was
    fitted to a beat of the 3-D model; the one of an adult, grown to the recorded size, if None. Raises InputError where
    the centre does not beat.
    """
    return concluded(Case.searched(recording, centre, rules), conditions or {})


def concluded(case: Case, conditions: Mapping[str, Recording]) -> Diagnosis:
    """The diagnosis after what was held out has decided which names are kept."""
    tried = tested(case, conditions)
    helping = [each for each, said in tried.items() if all(one.helps() for one in said)]
    told = {each: case.findings.log_bayes_factor(each) + _gained(tried[each], conditions) for each in helping}
    kept = likeliest(told, case.rules.group)
    verdict = _verdict(case, kept)
    best = next(iter([*kept, *tried]), ())
    return Diagnosis(
        verdict,
        tuple(case.cause(each, name) for each in kept for name in each),
        tuple(kept[1:]) if case.verdict == "group" else case.findings.decision.alternatives,
        _next_measurement(case, verdict, kept),
        tuple(gain for said in tried.get(best, ()) for gain in said.gains()),
        case.twin.simulations,
        case.recording.period,
        case.rules.detected,
        case.ranking(),
        tuple(name for each in tried if each not in helping for name in each),
        traces(case.findings, case.findings.of(best), case.data),
        unsearched={name: why for name, why in UNSEARCHED.items() if name in case.recording.curves},
        phases=case.phases(),
        tried=case.tried(),
        samples=case.data.values.size,
    )


def tested(case: Case, conditions: Mapping[str, Recording]) -> dict[Effects, list[Predicted]]:
    """What each explanation predicts of other conditions.

    Without any it is half of the recording, and the best answers for its group: what all of the data do not tell apart
    half of them does not.
    """
    if conditions:
        return {each: held_out(case, each, conditions) for each in case.explanations}
    best = held_out(case, case.explanations[0], {}) if case.explanations else []
    return dict.fromkeys(case.explanations, best)


def held_out(case: Case, effects: Effects, conditions: Mapping[str, Recording]) -> list[Predicted]:
    """Predictions without and with the effects, of every condition or, without one, of half of the recording."""
    added = tuple(case.library[name] for name in effects)
    fits = case.findings.survey.none.fit.x, case.findings.of(effects).fit.x
    centre = case.twin.centre
    found = [in_condition(name, centre, data_of(each), added, *fits) for name, each in conditions.items()]
    return [each for each in found or [on_half(centre, case.data, added, *fits)] if each is not None]


def _gained(said: Sequence[Predicted], conditions: Mapping[str, Recording]) -> float:
    """The ln likelihood that other conditions add; half of the recording adds nothing, it has been counted."""
    return sum(each.gained() for each in said) if conditions else 0.0


def likeliest(score: Mapping[Effects, float], within: float) -> list[Effects]:
    """The effects whose ln evidence is ``within`` so much of the best, the best first."""
    least = max(score.values(), default=0.0) - within
    return sorted((each for each in score if score[each] > least), key=lambda each: -score[each])


def _verdict(case: Case, kept: Sequence[Effects]) -> Verdict:
    if not case.explanations:
        return case.verdict
    if not kept:
        return "unknown"
    return "named" if case.verdict == "group" and len(kept) == 1 else case.verdict


def _next_measurement(case: Case, verdict: Verdict, kept: Sequence[Effects]) -> str:
    """What would decide between the members of a group, or between the two best where nothing is named."""
    if "lv_pressure" not in case.recording.curves:
        return PRESSURE
    if verdict == "group":
        rivals = [case.findings.of(each) for each in kept[:3]]
    elif verdict == "unknown":
        rivals = list(case.findings.survey.singles[:2])
    else:
        return ""
    return next_measurement(case.twin.centre, case.data, case.library, rivals) if len(rivals) > 1 else ""
