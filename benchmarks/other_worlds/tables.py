"""Verdicts on hearts of other simulators, counted by simulator and kind of heart."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS, FreeParameter
from heartfit.observation.noise_model import Share
from heartfit.results.text import CURVES, spaced_name
from heartfit.synthetic.other_worlds import EXPECTED, OtherHeart
from heartfit.synthetic.scoring import SILENT
from heartfit.synthetic.trial import ScoredDiagnosis

OUTCOMES = ("right", "unknown", "nothing", "wrong")
"""Right: the illness named, alone or in a group, or nothing in a heart that needs no mechanism; wrong: other names."""
HEALTHY, PARAMETERS, MECHANISM = "healthy", "ill by parameters", "ill by a mechanism"
ALONE, AGAINST, ALL = "alone", "against the healthy beat", "all"
STRONGEST = 3
"""Number of mechanisms of the ranking that are listed."""


@dataclass(frozen=True, eq=False)
class Judged:
    """A heart of another simulator and its diagnosis.

    recording: ALONE or AGAINST; misfit: root mean square residual of the model without a mechanism, over the
    standard deviation of the noise, by curve; scale: most probable one of the structural covariance.
    """

    heart: OtherHeart
    recording: str
    finding: ScoredDiagnosis
    misfit: Mapping[str, float]
    scale: float

    @classmethod
    def from_diagnosis(cls, heart: OtherHeart, recording: str, diagnosis: Diagnosis) -> "Judged":
        """Judge a diagnosis."""
        misfit = {
            trace.curve: float(np.sqrt(np.mean(((trace.measured - trace.none) / trace.noise) ** 2)))
            for trace in diagnosis.traces
        }
        finding = ScoredDiagnosis.of(diagnosis, 0.0)
        return cls(heart, recording, finding, misfit, diagnosis.structural_scale)

    @property
    def kind(self) -> str:
        """Kind of heart: one of HEALTHY, PARAMETERS and MECHANISM."""
        if self.heart.expected:
            return MECHANISM
        return PARAMETERS if self.heart.illness else HEALTHY

    @property
    def outcome(self) -> str:
        """One of OUTCOMES."""
        verdict, expected = self.finding.verdict, self.heart.expected
        if verdict in SILENT:
            return "nothing" if expected else "right"
        if verdict == "unknown":
            return "unknown"
        return "right" if self.finding.names & expected else "wrong"


def outcomes_table(judged: Sequence[Judged]) -> pd.DataFrame:
    """Return outcomes by recording, simulator and kind of heart; then those of all simulators."""
    groups: dict[tuple[str, str, str], list[Judged]] = {}
    for simulator in (*dict.fromkeys(one.heart.world for one in judged), ALL):
        for one in judged:
            if simulator in (ALL, one.heart.world):
                groups.setdefault((one.recording, simulator, one.kind), []).append(one)
    columns = ("recording", "simulator", "hearts")
    return pd.DataFrame(
        [_outcomes(dict(zip(columns, key, strict=True)), group) for key, group in groups.items()]
    )


def changes_table(judged: Sequence[Judged]) -> pd.DataFrame:
    """Return outcomes of ill hearts against their healthy beats by severity and illness; then sums."""
    groups: dict[tuple[str, str], list[Judged]] = {}
    for one in judged:
        severity, illness = one.heart.severity, one.heart.illness
        for key in ((severity, illness), (severity, one.kind), (ALL, one.kind), (ALL, ALL)):
            groups.setdefault(key, []).append(one)
    order = {illness: place for place, illness in enumerate((*EXPECTED, PARAMETERS, MECHANISM, ALL))}
    rows = sorted(groups.items(), key=lambda row: (row[0][0] == ALL, row[0][0], order[row[0][1]]))
    return pd.DataFrame(
        [_outcomes({"severity": severity, "illness": illness}, group) for (severity, illness), group in rows]
    )


def _outcomes(names: Mapping[str, str], group: Sequence[Judged]) -> dict[str, object]:
    counts = {outcome: sum(one.outcome == outcome for one in group) for outcome in OUTCOMES}
    share = Share.from_count(counts["right"], len(group))
    interval = f"{100.0 * share.low:.0f} to {100.0 * share.high:.0f}"
    return {**names, "number": len(group), **counts, "right (%), 95 % CI": interval}


def fits_table(judged: Sequence[Judged]) -> pd.DataFrame:
    """Return medians of the residual of healthy hearts without a mechanism, over the noise, by simulator."""
    groups: dict[str, list[Judged]] = {}
    for one in judged:
        if one.kind == HEALTHY:
            groups.setdefault(one.heart.world, []).append(one)
    return pd.DataFrame([_fits(world, group) for world, group in groups.items()])


def _fits(world: str, group: Sequence[Judged]) -> dict[str, object]:
    medians = {
        f"{CURVES[curve]}, over noise": _median(one.misfit[curve] for one in group)
        for curve in group[0].misfit
    }
    scale = _median(one.scale for one in group)
    return {"simulator": world, "healthy hearts": len(group), **medians, "scale of the structure": scale}


def _median(values: Iterable[float]) -> str:
    return f"{np.median(list(values)):.1f}"


def hearts_table(judged: Sequence[Judged]) -> pd.DataFrame:
    """Return a row for every heart: what it is, the verdict, and the best of the ranking."""
    return pd.DataFrame([_row(one) for one in judged])


def _row(one: Judged) -> dict[str, object]:
    best = list(one.finding.ranking.items())[:STRONGEST]
    return {
        "simulator": one.heart.world,
        "seed": one.heart.seed,
        "heart": f"{one.heart.severity} {one.heart.illness}".strip() or HEALTHY,
        "recording": one.recording,
        "verdict": f"`{one.finding.verdict}`",
        "named": ", ".join(sorted(map(spaced_name, one.finding.names))),
        "outcome": one.outcome,
        "largest ln Bayes factors": ", ".join(f"{spaced_name(name)} {factor:.1f}" for name, factor in best),
    }


def priors_table() -> pd.DataFrame:
    """Return the standard deviations of the free parameters about a person, between people, and of a change."""
    return pd.DataFrame([_priors(parameter) for parameter in FREE_PARAMETERS])


def _priors(parameter: FreeParameter) -> dict[str, object]:
    unit = {"ratio": "of the logarithm", "s": "s", "1": "1"}[parameter.change_unit]
    return {
        "parameter": f"`{parameter.name}`",
        "about a fitted person": parameter.person,
        "between people": parameter.people,
        "of a change": parameter.change,
        "unit": unit,
        "source of the spread between people": parameter.source,
    }
