"""Damaged files: truncated, emptied, with a changed byte; and truncated files of compiled kernels."""

from collections.abc import Callable
from random import Random

from tests.faults.outcome import Outcome, differences, one_more_call
from tests.faults.tiny import RESULTS, TinyStudy

KINDS = {
    "json": "volunteer1/physical/calibration/posterior.json",
    "csv": "volunteer1/curves/measured.csv",
    "vtu": "volunteer1/geometry/mesh.vtu",
    "npz": "volunteer1/registration/motion.npz",
    "nrrd": "volunteer1/images/cine.nrrd",
    "table": "tables/table1.md",
    "figure": "figures/volunteer1_physical.png",
}
"""One file of each kind that the study writes."""

Damage = Callable[[bytes, Random], bytes]
WAYS: dict[str, Damage] = {
    "truncated to half": lambda whole, chance: whole[: len(whole) // 2],
    "without its last line": lambda whole, chance: whole[: whole.rstrip().rfind(b"\n") + 1],
    "emptied": lambda whole, chance: b"",
    "with one byte changed": lambda whole, chance: _changed(whole, chance.randrange(len(whole))),
}


def damaged(study: TinyStudy, expected: dict[str, str], chance: Random, ways: int) -> list[Outcome]:
    """One file of every kind spoilt in the same way, for some of the ways."""
    return [_damaged_so(study, expected, chance, way) for way in list(WAYS)[:ways]]


def _damaged_so(study: TinyStudy, expected: dict[str, str], chance: Random, way: str) -> Outcome:
    study.put_back()
    files = [study.folder / RESULTS / name for name in KINDS.values()]
    for file in files:
        file.write_bytes(WAYS[way](file.read_bytes(), chance))
    code, output = study.run(targets=[f"{RESULTS}/{name}" for name in KINDS.values()])
    named = [name for name in KINDS.values() if f"{RESULTS}/{name} was altered" in output]
    kept = [file for file in files if file.with_name(f"{file.name}.altered").exists()]
    mended = code == 0 and len(named) == len(kept) == len(KINDS) and not differences(study.sums(), expected)
    fault = f"a {', a '.join(KINDS)}, each {way}"
    return Outcome(
        fault, f"{len(named)} of {len(KINDS)} reported, renamed and made again by that call", mended
    )


def cut_kernels(study: TinyStudy, expected: dict[str, str], chance: Random) -> list[Outcome]:
    """Half of what numba keeps of its compiled kernels cut off or emptied."""
    study.put_back()
    study.remove("volunteer1/physical", "tables", "figures")
    files = [file for file in sorted((study.folder / "src").rglob("*.nb[ci]")) if chance.random() < 0.5]
    for file in files:
        whole = file.read_bytes()
        file.write_bytes(whole[: chance.randrange(len(whole))])
    mended = len(files) > 0 and one_more_call(study, expected)
    return [
        Outcome(
            f"{len(files)} files of compiled kernels truncated at random positions", "compiled again", mended
        )
    ]


def _changed(whole: bytes, place: int) -> bytes:
    return whole[:place] + bytes([whole[place] ^ 0x10]) + whole[place + 1 :]
