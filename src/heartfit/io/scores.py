"""Scored cases: the only place where findings meet their sealed answers."""

from collections.abc import Iterable
from pathlib import Path

from heartfit.io.planted import read_findings
from heartfit.io.seals import open_seal
from heartfit.synthetic.case import Answer
from heartfit.synthetic.scoring import Scored


def read_scored(findings: Iterable[Path], sealed: Iterable[Path]) -> list[Scored]:
    """Read the findings of several files with their answers, each file with its folder of seals."""
    return [
        Scored(open_seal(Path(folder, f"{seed}.answer"), Answer), finding)
        for path, folder in zip(findings, sealed, strict=True)
        for seed, finding in read_findings(Path(path)).items()
    ]
