"""Findings beside their answers: the only place where a seal is opened."""

from collections.abc import Iterable
from pathlib import Path

from heartfit.io.findings import read_findings
from heartfit.io.planted import open_seal
from heartfit.planting.scoring import Scored


def read_scored(findings: Iterable[Path], sealed: Iterable[Path]) -> list[Scored]:
    """Every finding of some files beside its answer in the folder of seals that belongs to the file, opened now."""
    return [
        Scored(open_seal(Path(folder, f"{seed}.answer")), finding)
        for path, folder in zip(findings, sealed, strict=True)
        for seed, finding in read_findings(Path(path)).items()
    ]
