"""The cause of what a simulation gets wrong as cause.json: SI numbers beside their units."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from heartfit.diagnosis.cause import Cause, Diagnosis, Gain, Refitted, Tried, Verdict
from heartfit.diagnosis.departure import Departure, departures
from heartfit.errors import InputError
from heartfit.io.atomic import replacing, write_text
from heartfit.io.made_by import versions
from heartfit.io.traces import read_traces, write_traces
from heartfit.tables.cause_card import card, missed, sentence
from heartfit.tables.cause_figure import plot_cause


@dataclass(frozen=True)
class CauseFile:
    """What a cause.json holds; see :class:`heartfit.diagnosis.cause.Diagnosis`.

    departures: the greatest of each curve; misses: the same in words; threshold: the least ln Bayes factor of a
    detection; self_test: the median of the largest where nothing is hidden; made_by: versions.
    """

    verdict: Verdict
    mechanisms: tuple[Cause, ...]
    alternatives: tuple[tuple[str, ...], ...]
    next_measurement: str
    gain: tuple[Gain, ...]
    simulations: int
    fingerprint: str
    ranking: Mapping[str, float] = field(default_factory=dict)
    withdrawn: tuple[str, ...] = ()
    departures: tuple[Departure, ...] = ()
    misses: tuple[str, ...] = ()
    unsearched: Mapping[str, str] = field(default_factory=dict)
    refitted: Refitted | None = None
    threshold: float | None = None
    self_test: float | None = None
    tried: tuple[Tried, ...] = ()
    samples: int = 0
    made_by: str = ""

    @classmethod
    def of(cls, diagnosis: Diagnosis, fingerprint: str) -> "CauseFile":
        """Everything but the curves."""
        found = tuple(departures(diagnosis))
        return cls(
            diagnosis.verdict,
            diagnosis.mechanisms,
            diagnosis.alternatives,
            diagnosis.next_measurement,
            diagnosis.gain,
            diagnosis.simulations,
            fingerprint,
            diagnosis.ranking,
            diagnosis.withdrawn,
            found,
            tuple(map(missed, found)),
            diagnosis.unsearched,
            diagnosis.refitted,
            diagnosis.threshold,
            diagnosis.self_test,
            diagnosis.tried,
            diagnosis.samples,
            versions(),
        )


FILE = TypeAdapter(CauseFile)


def cause_schema() -> str:
    """The JSON schema of a cause.json."""
    return json.dumps(FILE.json_schema(), indent=1) + "\n"


def write_cause(path: Path, diagnosis: Diagnosis, fingerprint: str) -> None:
    """Write everything but the curves."""
    write_text(path, json.dumps(asdict(CauseFile.of(diagnosis, fingerprint)), indent=1) + "\n")


def write_cause_card(folder: Path, diagnosis: Diagnosis, title: str, fingerprint: str) -> str:
    """Write cause.json, cause.md, cause.png and traces.json; the diagnosis in a sentence."""
    write_cause(Path(folder, "cause.json"), diagnosis, fingerprint)
    write_traces(Path(folder, "traces.json"), diagnosis, fingerprint)
    write_text(Path(folder, "cause.md"), card(diagnosis, title))
    with replacing(Path(folder, "cause.png")) as draft:
        plot_cause(diagnosis).savefig(draft, dpi=150)
    return f"{sentence(diagnosis)} See {folder / 'cause.md'} and {folder / 'cause.png'}."


def read_cause(path: Path) -> dict[str, Any]:
    """The content by key; raises InputError for a missing or broken file."""
    try:
        content: dict[str, Any] = json.loads(Path(path).read_text(encoding="utf-8"))
        FILE.validate_python(content)
    except ValidationError as problem:
        first = problem.errors()[0]
        said = f"{'.'.join(map(str, first['loc']))}: {first['msg']}"
    except (OSError, ValueError) as problem:
        said = str(problem)
    else:
        return content
    raise InputError(f"{path}: {said}; expected a cause.json: diagnose the recording again")


def read_diagnosis(folder: Path) -> Diagnosis:
    """The diagnosis that write_cause_card wrote; raises InputError for a missing or broken file."""
    found = FILE.validate_python(read_cause(Path(folder, "cause.json")))
    shared = {each.name for each in fields(Diagnosis)} & {each.name for each in fields(CauseFile)}
    said = {name: getattr(found, name) for name in shared if getattr(found, name) is not None}
    return Diagnosis(**{"threshold": float("nan"), **said, **read_traces(Path(folder, "traces.json"))})
