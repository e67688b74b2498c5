"""A diagnosis on trial: what it says of a recording, in the form that is scored. It knows of no answer."""

import time as clock
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cache

from heartfit.diagnosis.case import Case
from heartfit.diagnosis.cause import Cause, Diagnosis
from heartfit.diagnosis.diagnose import concluded, diagnose
from heartfit.diagnosis.recording import Recording
from heartfit.errors import InputError

REFUSED = "refused"
"""The verdict where the diagnosis did not take the recording."""
VOLUME, CONDITION = "volume alone", "volume, pressure and raised legs"
"""Less and more data than volume and pressure at rest."""


@dataclass(frozen=True)
class Finding:
    """What a diagnosis said of a case.

    ``ranking``: ln Bayes factors of all single mechanisms; ``gain``: error ratios by curve on what was held out;
    ``other``: what was said of less and of more data, by its name.
    """

    verdict: str
    mechanisms: tuple[Cause, ...] = ()
    ranking: Mapping[str, float] = field(default_factory=dict)
    gain: Mapping[str, float] = field(default_factory=dict)
    simulations: int = 0
    seconds: float = 0.0
    other: Mapping[str, "Finding"] = field(default_factory=dict)

    @property
    def names(self) -> frozenset[str]:
        return frozenset(each.name for each in self.mechanisms)

    @classmethod
    def of(cls, diagnosis: Diagnosis, seconds: float) -> "Finding":
        """The part of a diagnosis that is scored, and the time of the processor that it took, s."""
        gain = {each.curve: each.ratio for each in diagnosis.gain}
        said = diagnosis.verdict, diagnosis.mechanisms, dict(diagnosis.ranking), gain
        return cls(*said, diagnosis.simulations, seconds)


def found(recording: Recording, search: Callable[[Recording], Diagnosis] = diagnose) -> Finding:
    """What the search says of the recording; a refusal claims nothing."""
    started = clock.process_time()
    try:
        diagnosis = search(recording)
    except InputError:
        return Finding(REFUSED)
    return Finding.of(diagnosis, clock.process_time() - started)


def found_by_data(rest: Recording, conditions: Mapping[str, Recording]) -> Finding:
    """What is said of the recording at rest and, of a heart under other conditions too, of less and of more data."""
    if not conditions:
        return found(rest)
    searched = cache(Case.searched)  # once for both: a condition is never fitted
    volume = replace(rest, curves={"lv_volume": rest.curves["lv_volume"]})
    said = found(rest, lambda each: concluded(searched(each), {}))
    more = found(rest, lambda each: concluded(searched(each), conditions))
    return replace(said, other={VOLUME: found(volume), CONDITION: more})
