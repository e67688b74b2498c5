"""The list of mutants fits the sources, the page shows every one of them caught, and the check itself can tell."""

from pathlib import Path

import pytest
from tests.mutations import run
from tests.mutations.mutants import MUTANTS, Mutant
from tests.mutations.run import PAGE, ROOT, MutationError, Verdict, row

KERNELS = {
    "active/bcs", "mooney_rivlin", "guccione", "kinematics", "assembly", "elements", "cavity", "eikonal", "windkessel",
    "branch", "unscented", "scaling", "simplex", "iterated", "smoother", "unloading", "solver", "sphere",
}  # fmt: skip


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda mutant: mutant.what)
def test_what_a_mutant_changes_stands_once_in_the_sources(mutant):
    assert (ROOT / "src" / "heartfit" / mutant.file).read_text().count(mutant.old) == 1
    assert mutant.new != mutant.old
    assert all((ROOT / tests.split("::")[0]).exists() for tests in mutant.tests.split())


def test_every_kernel_has_mutants_and_every_mutant_a_name():
    assert len(MUTANTS) >= 25
    assert len({mutant.what for mutant in MUTANTS}) == len(MUTANTS)
    assert not [kernel for kernel in KERNELS if not any(kernel in mutant.file for mutant in MUTANTS)]


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
def test_survivors_are_told_from_the_caught(tmp_path, monkeypatch, text, caught):
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


def test_a_row_shows_what_was_dropped():
    shown = row(Verdict(Mutant("drop", "kernel.py", "    x -= y\n", "", "t"), "mechanics/test_x.py::test_y"))
    assert shown == "| drop | `kernel.py`: nothing | `x -= y` | `mechanics/test_x.py::test_y` |\n"
