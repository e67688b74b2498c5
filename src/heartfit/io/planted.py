"""Recordings of planted cases, and what a diagnosis concludes of them; no answer is read here."""

from collections.abc import Mapping
from pathlib import Path

from heartfit.discovery.sphere_model.recording import Recording
from heartfit.io.recordings import MEASURED, read_recording
from heartfit.io.results import read_record, write_result
from heartfit.synthetic.trial import ScoredDiagnosis


def read_planted(measured: Path) -> dict[str, Recording]:
    """Read the recordings at rest of a folder of cases, by seed."""
    files = sorted(Path(measured).glob(f"*/{MEASURED}"))
    return {file.parent.name: read_recording(file) for file in files}


def read_conditions_of(measured: Path) -> list[dict[str, Recording]]:
    """Read the recordings under other conditions by name, one mapping for each case of :func:`read_planted`."""
    folders = sorted(file.parent for file in Path(measured).glob(f"*/{MEASURED}"))
    return [
        {file.stem: read_recording(file) for file in sorted(folder.glob("*.csv")) if file.name != MEASURED}
        for folder in folders
    ]


def write_findings(path: Path, findings: Mapping[str, ScoredDiagnosis], fingerprint: str) -> None:
    """Write scored diagnoses by seed."""
    write_result(path, findings, fingerprint, {"amplitude": "SI", "simulations": "1", "seconds": "s"})


def read_findings(path: Path) -> dict[str, ScoredDiagnosis]:
    """Read scored diagnoses by seed; raises InputError for a missing or broken file."""
    return read_record(path, dict[str, ScoredDiagnosis])
