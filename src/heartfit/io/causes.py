"""Diagnoses: cause.json with the verdict, traces.json with the curves behind it, the card and its figure.

cause.json and traces.json together restore the whole diagnosis. Curves are in SI units.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from heartfit.core.errors import InputError
from heartfit.discovery.inference.decide import Verdict
from heartfit.discovery.inference.margin import Margin
from heartfit.discovery.sphere_model.cause import (
    ActingPlace,
    Cause,
    Change,
    CurveFit,
    Diagnosis,
    FittedModel,
    Gain,
    PlaceFunction,
    Refitted,
    ShownModel,
    Trace,
    UnnamedCandidate,
)
from heartfit.discovery.sphere_model.misfit import Departure, departures
from heartfit.discovery.sphere_model.strokes import Strokes
from heartfit.io.files import replacing, write_text
from heartfit.io.fingerprint import versions
from heartfit.io.results import read_record, write_result
from heartfit.observation.beat import BeatPhases
from heartfit.results.cause_figure import RenderedCause

UNITS = {"times": "s", "volumes": "m^3", "pressures": "Pa"}


@dataclass(frozen=True, eq=False)
class TraceFile:
    """Content of traces.json: period [s], phases of the beat if it has them, curves and functions of a diagnosis."""

    period: float
    phases: BeatPhases | None
    traces: tuple[Trace, ...]
    functions: tuple[PlaceFunction, ...] = ()


def write_traces(path: Path, diagnosis: Diagnosis, fingerprint: str) -> None:
    """Write period, phases and curves of a diagnosis."""
    traces = TraceFile(diagnosis.period, diagnosis.phases, diagnosis.traces, diagnosis.functions)
    write_result(path, traces, fingerprint, UNITS)


def read_traces(path: Path) -> dict[str, Any]:
    """Read period, phases and curves by their names in Diagnosis; raises InputError for a missing or broken file."""
    return vars(read_record(path, TraceFile))


@dataclass(frozen=True)
class CauseFile:
    """Content of a cause.json; see :class:`heartfit.discovery.sphere_model.cause.Diagnosis`.

    departures: of each curve of the simulation without a cause; misses: the sentences of the card on the misfit;
    threshold: smallest ln Bayes factor of a detection; self_test: median over hearts without a hidden effect of their
    largest ln Bayes factor; made_by: versions of the software.
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
    tried: tuple[FittedModel, ...] = ()
    samples: int = 0
    from_all_samples: tuple[Cause, ...] = ()
    warnings: tuple[str, ...] = ()
    structural_scale: float = 0.0
    changes: tuple[Change, ...] = ()
    acting: tuple[ActingPlace, ...] = ()
    strokes: Strokes | None = None
    read_twice: Mapping[str, float] = field(default_factory=dict)
    model: ShownModel = "sphere"
    free_parameters: int = 0
    candidate: UnnamedCandidate | None = None
    fits: tuple[CurveFit, ...] = ()
    margin: Margin | None = None
    made_by: str = ""

    @classmethod
    def of(cls, diagnosis: Diagnosis, misses: Sequence[str], fingerprint: str) -> "CauseFile":
        """Collect the fields of a diagnosis, without its curves."""
        stored: dict[str, Any] = {name: getattr(diagnosis, name) for name in SHARED}
        return cls(
            departures=tuple(departures(diagnosis)),
            misses=tuple(misses),
            fingerprint=fingerprint,
            made_by=versions(),
            **stored,
        )


SHARED = {entry.name for entry in fields(CauseFile)} & {entry.name for entry in fields(Diagnosis)}
"""Fields of a diagnosis in its cause.json; the others are in its traces.json."""
FILE = TypeAdapter(CauseFile)


def cause_schema() -> str:
    """JSON schema of a cause.json."""
    return json.dumps(FILE.json_schema(), indent=1) + "\n"


def write_cause(path: Path, diagnosis: Diagnosis, misses: Sequence[str], fingerprint: str) -> None:
    """Write a cause.json; ``misses`` has one sentence for each curve that the simulation gets wrong."""
    write_text(path, json.dumps(asdict(CauseFile.of(diagnosis, misses, fingerprint)), indent=1) + "\n")


def write_cause_card(folder: Path, rendered: RenderedCause, fingerprint: str) -> None:
    """Write cause.json, cause.md, cause.png and traces.json."""
    write_cause(Path(folder, "cause.json"), rendered.diagnosis, rendered.misses, fingerprint)
    write_traces(Path(folder, "traces.json"), rendered.diagnosis, fingerprint)
    write_text(Path(folder, "cause.md"), rendered.card)
    with replacing(Path(folder, "cause.png")) as draft:
        rendered.figure.savefig(draft, dpi=150)


@dataclass(frozen=True)
class TriedModels:
    """Models that a diagnosis fitted, and its verdict.

    threshold: ln Bayes factor of a detection; samples: number of data that each model was fitted to.
    """

    tried: tuple[FittedModel, ...]
    verdict: Verdict
    threshold: float
    samples: int


def read_tried(path: Path) -> TriedModels:
    """Read the fitted models of a cause.json; raises InputError for a missing or broken file, or one without models."""
    cause = FILE.validate_python(read_cause(path))
    if not cause.tried or cause.threshold is None:
        raise InputError(
            f"{path}: holds no models; expected the models of a diagnosis: diagnose the recording again"
        )
    return TriedModels(cause.tried, cause.verdict, cause.threshold, cause.samples)


def read_cause(path: Path) -> dict[str, Any]:
    """Read the content of a cause.json by key; raises InputError for a missing or broken file."""
    try:
        content: dict[str, Any] = json.loads(Path(path).read_text(encoding="utf-8"))
        FILE.validate_python(content)
    except ValidationError as error:
        first = error.errors()[0]
        problem = f"{'.'.join(map(str, first['loc']))}: {first['msg']}"
    except (OSError, ValueError) as error:
        problem = str(error)
    else:
        return content
    raise InputError(f"{path}: {problem}; expected a cause.json: diagnose the recording again")


def read_diagnosis(folder: Path) -> Diagnosis:
    """Read the diagnosis that write_cause_card wrote; raises InputError for a missing or broken file."""
    cause = FILE.validate_python(read_cause(Path(folder, "cause.json")))
    stored = {name: getattr(cause, name) for name in SHARED if getattr(cause, name) is not None}
    return Diagnosis(**{"threshold": float("nan"), **stored, **read_traces(Path(folder, "traces.json"))})
