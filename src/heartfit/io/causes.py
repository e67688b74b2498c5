"""The cause of what a simulation gets wrong as cause.json: SI numbers beside their units."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from heartfit.diagnosis.cause import Diagnosis
from heartfit.errors import InputError
from heartfit.io.atomic import replacing, write_text
from heartfit.tables.cause_card import card, sentence
from heartfit.tables.cause_figure import plot_cause

KEYS = ("verdict", "mechanisms", "alternatives", "next_measurement", "gain", "simulations", "fingerprint")
"""What every cause.json has."""


def write_cause(path: Path, diagnosis: Diagnosis, fingerprint: str) -> None:
    """Write everything but the curves."""
    content = {
        "verdict": diagnosis.verdict,
        "mechanisms": [asdict(each) for each in diagnosis.mechanisms],
        "alternatives": diagnosis.alternatives,
        "next_measurement": diagnosis.next_measurement,
        "gain": [asdict(each) for each in diagnosis.gain],
        "simulations": diagnosis.simulations,
        "ranking": diagnosis.ranking,
        "withdrawn": diagnosis.withdrawn,
        "refitted": asdict(diagnosis.refitted) if diagnosis.refitted else None,
        "fingerprint": fingerprint,
    }
    write_text(path, json.dumps(content, indent=1) + "\n")


def write_cause_card(folder: Path, diagnosis: Diagnosis, title: str, fingerprint: str) -> str:
    """Write cause.json, cause.md and cause.png; the diagnosis in a sentence."""
    write_cause(Path(folder, "cause.json"), diagnosis, fingerprint)
    write_text(Path(folder, "cause.md"), card(diagnosis, title))
    with replacing(Path(folder, "cause.png")) as draft:
        plot_cause(diagnosis).savefig(draft, dpi=150)
    return f"{sentence(diagnosis)} See {folder / 'cause.md'} and {folder / 'cause.png'}."


def read_cause(path: Path) -> dict[str, Any]:
    """The content by key; raises InputError for a missing or broken file."""
    try:
        content: dict[str, Any] = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as problem:
        raise InputError(f"{path}: {problem}; expected a cause.json: diagnose the recording again") from None
    missing = [key for key in KEYS if key not in content]
    if missing:
        raise InputError(
            f"{path}: no {', '.join(missing)}; expected a cause.json: diagnose the recording again"
        )
    return content
