"""The files of a folder of surface meshes, by phase and part."""

import re
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path

from heartfit.errors import InputError
from heartfit.geometry.joining import OPEN
from heartfit.geometry.motion import require_phases
from heartfit.io.surface_file import SUFFIXES

WHOLE = "closed surface"
NUMBERED = re.compile(r"(.*?)(\d+)(\D*)")
PART = re.compile(r"(LV_ENDO|RV_ENDO|EPI)(CARDIAL|CARDIUM)?", re.IGNORECASE)

Phase = dict[str, Path]
"""The files of one phase: one closed surface, or one file for each of lv_endo, rv_endo and epi."""


def phases_of(folder: Path) -> list[Phase]:
    """The files of every phase by the last number in their names; raises InputError unless all are there."""
    if not folder.is_dir():
        raise InputError(
            f"{folder}: no such folder; expected surface meshes ({', '.join(SUFFIXES)}), one a phase"
        )
    found: dict[int, Phase] = defaultdict(dict)
    for file in sorted(file for file in folder.iterdir() if file.suffix in SUFFIXES):
        number, part = _number_and_part(file)
        taken = found[number].setdefault(part, file)
        if taken is not file:
            raise InputError(f"{file}: the same phase and part as {taken.name}; remove one of the two")
    require_phases(len(found), str(folder))
    for number in range(min(found), max(found) + 1):
        _require_parts(folder, number, found)
    return [dict(sorted(found[number].items())) for number in sorted(found)]


def _number_and_part(file: Path) -> tuple[int, str]:
    match = NUMBERED.fullmatch(file.stem)
    if match is None:
        raise InputError(
            f"{file}: no number in its name; expected that of the phase, or another folder for it"
        )
    part = PART.search(match[1] + match[3])
    return int(match[2]), part[1].lower() if part else WHOLE


def _require_parts(folder: Path, number: int, found: Mapping[int, Phase]) -> None:
    parts = set(found.get(number, {}))
    if not parts:
        raise InputError(
            f"{folder}: phases {min(found)} to {max(found)}, but {number} is missing; export every phase"
        )
    if parts not in ({WHOLE}, set(OPEN)):
        raise InputError(
            f"{folder}: phase {number} has {', '.join(sorted(parts))}; expected one closed surface, or three files "
            "with LV_ENDO, RV_ENDO and EPI in their names"
        )
    if parts != set(found[min(found)]):
        raise InputError(
            f"{folder}: phase {number} is made of other files than phase {min(found)}; expected the same"
        )
