"""Diagnoses of planted recordings in the form that is scored; nothing here knows an answer."""

import time as clock
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.cause import Cause, Diagnosis
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.recording import Recording

REFUSED = "refused"
"""Verdict of a diagnosis that rejected the recording."""
VOLUME, CONDITION = "volume alone", "volume, pressure and raised legs"
"""Data sets in addition to volume and pressure at rest: a smaller and a larger one."""


@dataclass(frozen=True)
class ScoredDiagnosis:
    """Diagnosis of a case in the form that is scored, with sizes from all samples where the search saw half of them.

    ``ranking``: ln Bayes factors of all single mechanisms; ``gain``: error ratios by curve on held-out samples;
    ``seconds``: CPU time [s]; ``other``: diagnoses of the smaller and the larger data set, by its name.
    """

    verdict: str
    mechanisms: tuple[Cause, ...] = ()
    ranking: Mapping[str, float] = field(default_factory=dict)
    gain: Mapping[str, float] = field(default_factory=dict)
    simulations: int = 0
    seconds: float = 0.0
    other: "Mapping[str, ScoredDiagnosis]" = field(default_factory=dict)

    @property
    def names(self) -> frozenset[str]:
        return frozenset(cause.name for cause in self.mechanisms)

    @classmethod
    def of(cls, diagnosis: Diagnosis, seconds: float) -> "ScoredDiagnosis":
        """Extract the scored part of a diagnosis that took ``seconds`` of CPU time."""
        gains = {gain.curve: gain.ratio for gain in diagnosis.gain}
        final = {cause.name: cause for cause in diagnosis.from_all_samples}
        sizes = tuple(final.get(cause.name, cause) for cause in diagnosis.mechanisms)
        conclusion = diagnosis.verdict, sizes, dict(diagnosis.ranking), gains
        return cls(*conclusion, diagnosis.simulations, seconds)


def diagnose_recording(
    recording: Recording, search: Callable[[Recording], Diagnosis] = diagnose
) -> ScoredDiagnosis:
    """Diagnose the recording; an InputError becomes the verdict "refused", which claims nothing."""
    started = clock.process_time()
    try:
        diagnosis = search(recording)
    except InputError:
        return ScoredDiagnosis(REFUSED)
    return ScoredDiagnosis.of(diagnosis, clock.process_time() - started)


def diagnose_by_data(rest: Recording, conditions: Mapping[str, Recording]) -> ScoredDiagnosis:
    """Diagnose the recording at rest and, if there are other conditions, also the smaller and the larger data set."""
    if not conditions:
        return diagnose_recording(rest)
    volume = replace(rest, curves={"lv_volume": rest.curves["lv_volume"]})
    more = diagnose_recording(rest, lambda recording: diagnose(recording, conditions))
    return replace(diagnose_recording(rest), other={VOLUME: diagnose_recording(volume), CONDITION: more})
