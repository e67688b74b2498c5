"""Files that a study leaves, by what there is one of."""

import re
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

BEAT = r"[^.].*/calibration/beats/\d+\.json$"
"""One of a point's files; not the sum of it, whose folder's name begins with a dot."""


@dataclass(frozen=True)
class Footprint:
    """Files and megabytes for each `per` (study, case, setting or point) of a `kind` of subject."""

    per: str
    kind: str
    files: float
    megabytes: float


def footprints(
    sizes: Sequence[tuple[str, int]], kinds: Mapping[str, str], settings: Collection[str]
) -> list[Footprint]:
    """Means over a study.

    sizes: name below the results and bytes of every file; kinds: of each case.
    """
    files: Counter[tuple[str, str]] = Counter()
    held: Counter[tuple[str, str]] = Counter()
    for name, size in sizes:
        place = place_of(name, kinds, settings)
        files[place] += 1
        held[place] += size
    cases = Counter(kinds.values())
    points = Counter(kinds[name.split("/")[0]] for name, _ in sizes if re.match(BEAT, name))
    found = []
    for per, kind in sorted(files):
        number = {
            "study": 1,
            "case": cases[kind],
            "setting": cases[kind] * len(settings),
            "point": points[kind],
        }[per]
        found.append(Footprint(per, kind, files[per, kind] / number, held[per, kind] / number / 1e6))
    return found


def place_of(name: str, kinds: Mapping[str, str], settings: Collection[str]) -> tuple[str, str]:
    """Of what there is one of this file, and the kind of its subject, by the parts of its name."""
    parts = re.split(r"[/_.]", name)
    case = next((part for part in parts if part in kinds), "")
    if not case or parts[0] == "sensitivity":
        return "study", ""
    if re.search(r"/beats/\d+\.|/simulate_point_\d+\.", name):
        return "point", kinds[case]
    return "setting" if any(part in settings for part in parts) else "case", kinds[case]
