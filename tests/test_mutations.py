"""The list of mutants fits the sources; the page shows every mutant caught; the check distinguishes survivors."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.mutations import run
from tests.mutations.mutants import MUTANTS, Mutant
from tests.mutations.run import PAGE, ROOT, MutationError, Verdict, row

KERNELS = {
    "calibration/alternatives.py", "calibration/design.py", "calibration/unscented.py", "geometry/cavity.py",
    "heart/activation/eikonal.py", "heart/circulation/elements.py", "heart/finite_elements/assembly.py",
    "heart/finite_elements/elements.py", "heart/finite_elements/kinematics.py", "heart/finite_elements/solver.py",
    "heart/finite_elements/unloading.py", "heart/muscle/bcs.py", "heart/muscle/guccione.py", "heart/muscle/passive.py",
    "heart/sphere/body.py", "roles/laws.py",
}  # fmt: skip


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


def test_the_committed_page_has_every_mutant_and_all_were_caught():
    """Regenerate by `python3 study.py mutations`."""
    rows = [line.split(" | ") for line in PAGE.read_text().splitlines() if "`:" in line]
    assert [cells[0].removeprefix("| ") for cells in rows] == [mutant.what for mutant in MUTANTS]
    assert not [cells[0] for cells in rows if "nobody" in cells[-1]]


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
    (verdict,) = run.verdicts((Mutant("change", "kernel.py", "right", text, "tests"),))
    assert verdict.caught_by == caught
    assert ("nobody" in row(verdict)) is (caught == "")
    assert kernel.read_text() == "right"
    with pytest.raises(MutationError, match=r"0 times 'left'; expected one"):
        list(run.verdicts((Mutant("change", "kernel.py", "left", text, "tests"),)))


def test_a_row_shows_the_dropped_text():
    shown = row(Verdict(Mutant("drop", "kernel.py", "    x -= y\n", "", "t"), "mechanics/test_x.py::test_y"))
    assert shown == "| drop | `kernel.py`: nothing | `x -= y` | `mechanics/test_x.py::test_y` |\n"
