"""Planted recordings in, and what a diagnosis says of them out: nothing here reads an answer."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from heartfit.diagnosis.cause import Cause
from heartfit.diagnosis.recording import Recording
from heartfit.io.recordings import MEASURED, read_recording
from heartfit.io.results import read_result, write_result
from heartfit.planting.trial import Finding


def read_planted(measured: Path) -> dict[str, Recording]:
    """The recordings at rest, by seed, of a folder of cases."""
    files = sorted(Path(measured).glob(f"*/{MEASURED}"))
    return {file.parent.name: read_recording(file) for file in files}


def read_conditions_of(measured: Path) -> list[dict[str, Recording]]:
    """The recordings under other conditions by name, case by case as :func:`read_planted` has them."""
    folders = sorted(file.parent for file in Path(measured).glob(f"*/{MEASURED}"))
    return [
        {file.stem: read_recording(file) for file in sorted(folder.glob("*.csv")) if file.name != MEASURED}
        for folder in folders
    ]


def write_findings(path: Path, findings: Mapping[str, Finding], fingerprint: str) -> None:
    """Write what was said of some cases, by seed."""
    write_result(path, findings, fingerprint, {"amplitude": "SI", "simulations": "1", "seconds": "s"})


def read_findings(path: Path) -> dict[str, Finding]:
    """What write_findings wrote; raises InputError for a missing or broken file."""
    return {seed: _finding(content) for seed, content in read_result(path).items()}


def _finding(content: Mapping[str, Any]) -> Finding:
    named = tuple(Cause(**each | {"interval": tuple(each["interval"])}) for each in content["mechanisms"])
    other = {data: _finding(each) for data, each in content["other"].items()}
    return Finding(**dict(content) | {"mechanisms": named, "other": other})
