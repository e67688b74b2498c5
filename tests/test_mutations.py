"""The list of mutants fits the sources; the page shows every mutant caught; the check distinguishes survivors."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from tests.mutations import run, stored
from tests.mutations.catalogue import MUTANTS
from tests.mutations.mutant import Mutant
from tests.mutations.run import ROOT, MutationError, Verdict

KERNELS = {
    "calibration/alternatives.py", "calibration/design.py", "calibration/unscented.py", "geometry/cavity.py",
    "heart/activation/eikonal.py", "heart/circulation/elements.py", "heart/finite_elements/assembly.py",
    "heart/finite_elements/elements.py", "heart/finite_elements/kinematics.py", "heart/finite_elements/solver.py",
    "heart/finite_elements/unloading.py", "heart/muscle/bcs.py", "heart/muscle/guccione.py", "heart/muscle/passive.py",
    "heart/sphere/body.py", "roles/laws.py",
}  # fmt: skip
SUBJECTS = {
    "search": ("discovery/inference/search.py", "discovery/inference/evidence.py"),
    "decision": ("discovery/inference/decide.py",),
    "held-out data": ("discovery/sphere_model/held_out.py",),
    "withdrawal": ("discovery/sphere_model/diagnose.py", "discovery/sphere_model/searched_recording.py"),
    "recentring": ("discovery/sphere_model/recentred.py",),
    "refit": ("discovery/refit/refit.py",),
    "halves": ("discovery/refit/target.py",),
    "proof": ("discovery/refit/verdict.py", "discovery/refit/prove.py"),
    "planting": ("synthetic/hidden.py", "synthetic/campaign.py", "synthetic/case.py", "synthetic/sealed.py"),
    "scores": ("synthetic/scoring.py",),
    "update": ("calibration/update.py", "calibration/unscented.py"),
    "observation": ("observation/operator.py", "observation/curve.py"),
}
"""Files that choose, judge, plant or observe, by subject."""


def faults_of(mutant: Mutant) -> list[str]:
    """Reasons why a mutant cannot be tried: its text is not unique, changes nothing, or its tests are missing."""
    count = (ROOT / "src" / "heartfit" / mutant.file).read_text().count(mutant.old)
    missing = [name for name in mutant.tests.split() if not (ROOT / name.split("::")[0]).exists()]
    return [
        *([] if count == 1 else [f"{mutant.file} has its text {count} times"]),
        *(["changes nothing"] if mutant.new == mutant.old else []),
        *(f"no test {name}" for name in missing),
    ]


def test_every_mutant_changes_one_place_of_the_sources_and_has_tests():
    assert not {mutant.what: faults for mutant in MUTANTS if (faults := faults_of(mutant))}


def test_a_mutant_that_cannot_be_tried_is_listed():
    sound = MUTANTS[0]
    assert faults_of(replace(sound, old="no such text")) == [f"{sound.file} has its text 0 times"]
    assert faults_of(replace(sound, new=sound.old)) == ["changes nothing"]
    assert faults_of(replace(sound, tests="tests/nowhere.py::test")) == ["no test tests/nowhere.py::test"]


def test_every_kernel_has_mutants_and_every_mutant_a_name():
    assert len(MUTANTS) >= 25
    assert len({mutant.what for mutant in MUTANTS}) == len(MUTANTS)
    assert not KERNELS - {mutant.file for mutant in MUTANTS}


@pytest.mark.parametrize("subject", SUBJECTS)
def test_what_chooses_judges_plants_and_observes_has_two_mutants_in_every_file(subject):
    counts = Counter(mutant.file for mutant in MUTANTS)
    assert all(counts[file] >= 2 for file in SUBJECTS[subject]), counts


def test_every_mutant_has_a_stored_verdict_and_all_were_caught():
    """Try the others by `python3 study.py mutations`."""
    rows = stored.read_rows()
    assert list(rows) == [stored.key(mutant) for mutant in MUTANTS]
    assert not [cells[0] for cells in rows.values() if cells[3] == stored.NOBODY]


def test_the_tests_that_caught_a_mutant_still_exist():
    caught = {cells[3].strip("`") for cells in stored.read_rows().values()}
    lost = []
    for name in sorted(caught):
        file, _, test = name.partition("::")
        source = ROOT / "tests" / file
        if not source.exists() or (test and f"def {test.split('[')[0]}(" not in source.read_text()):
            lost.append(name)
    assert not lost


class Fake:
    """A copy that fails of a mutant in force, or without one."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.inside = folder, False

    mutated = run.Copy.mutated

    def first_failure(self, tests: str) -> str:
        text = (self.folder / "src" / "heartfit" / "kernel.py").read_text()
        return "a test" if text == "wrong" else ""


@pytest.mark.parametrize(("text", "caught"), [("wrong", "a test"), ("harmless", "")])
def test_survivors_are_distinguished_from_caught_mutants(tmp_path, monkeypatch, text, caught):
    kernel = tmp_path / "src" / "heartfit" / "kernel.py"
    kernel.parent.mkdir(parents=True)
    kernel.write_text("right")
    monkeypatch.setattr(run, "Copy", lambda _: Fake(tmp_path))
    (verdict,) = run.verdicts([Mutant("change", "kernel.py", "right", text, "tests")])
    assert verdict.caught_by == caught
    assert (stored.NOBODY in stored.row(verdict, "today")) is (caught == "")
    assert kernel.read_text() == "right"
    with pytest.raises(MutationError, match=r"0 times 'left'; expected one"):
        list(run.verdicts([Mutant("change", "kernel.py", "left", text, "tests")]))


def test_a_row_shows_the_dropped_text():
    verdict = Verdict(Mutant("drop", "kernel.py", "    x -= y\n", "", "t"), "mechanics/test_x.py::test_y")
    assert stored.row(verdict, "2026-11-23") == (
        "drop",
        "`kernel.py`: nothing",
        "`x -= y`",
        "`mechanics/test_x.py::test_y`",
        "2026-11-23",
    )


@pytest.fixture
def tried(tmp_path, monkeypatch):
    """Two mutants, the first of which has a stored verdict."""
    mutants = [Mutant(name, "kernel.py", "right | left", name, "tests") for name in ("old", "new")]
    monkeypatch.setattr(stored, "MUTANTS", mutants)
    monkeypatch.setattr(stored, "STORED", tmp_path / "mutations.tsv")
    first = Verdict(mutants[0], "test_x.py::test_y")
    stored.write_rows({stored.key(mutants[0]): stored.row(first, "2026-11-23")})
    return mutants


def test_verdicts_are_kept_until_their_mutant_changes(tried, monkeypatch):
    old, new = tried
    assert stored.read_rows() == {
        stored.key(old): stored.row(Verdict(old, "test_x.py::test_y"), "2026-11-23")
    }
    assert stored.chosen([]) == [new]
    assert stored.chosen(["old"]) == [old]
    assert stored.chosen(["--all"]) == [old, new]
    monkeypatch.setattr(stored, "MUTANTS", [replace(old, new="another text"), new])
    assert [mutant.what for mutant in stored.chosen([])] == ["old", "new"]


def test_a_mutant_that_is_not_listed_is_refused(tried):
    with pytest.raises(SystemExit, match="no mutant older"):
        stored.chosen(["older"])
