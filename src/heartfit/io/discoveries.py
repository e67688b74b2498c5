"""Searches and refits of a study's cases, each with the answer of a sealed heart: only the evaluation reads both."""

from collections.abc import Collection, Sequence
from pathlib import Path

from heartfit.io.causes import read_diagnosis
from heartfit.io.results import read_truth
from heartfit.io.seals import open_effects
from heartfit.results.discovery import DiscoveryResult


def read_discoveries(
    results: Path, refitted: Sequence[tuple[str, str]], virtual: Collection[str]
) -> list[DiscoveryResult]:
    """Read the diagnoses of pairs of case and setting; those of ``virtual`` hearts with their hidden effects."""
    return [_read(Path(results, case), setting, case in virtual) for case, setting in refitted]


def _read(folder: Path, setting: str, virtual: bool) -> DiscoveryResult:
    discovery, cohort = folder / "discovery" / setting, folder / "cohort"
    answer = (
        (open_effects([cohort / "effects.sealed"]), read_truth(cohort / "truth.json"))
        if virtual
        else (None, None)
    )
    return DiscoveryResult(
        folder.name, setting, read_diagnosis(discovery / "search"), read_diagnosis(discovery), *answer
    )
