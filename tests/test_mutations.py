"""The table of mutants fits the sources, every one was caught, and survivors are told from those that are caught."""

from pathlib import Path

import pytest

from tests import mutations
from tests.checkout import PACKAGE, ROOT
from tests.mutations import SURVIVED, Mutant, MutationError

MUTANTS = mutations.read_mutants()
STAGES = {
    "calibration",
    "discovery/inference",
    "discovery/refit",
    "discovery/sphere_model",
    "geometry",
    "heart",
    "heart/activation",
    "heart/circulation",
    "heart/finite_elements",
    "heart/muscle",
    "heart/sphere",
    "imaging/registration",
    "observation",
    "results",
    "roles",
    "synthetic",
}


def faults_of(mutant: Mutant) -> list[str]:
    """Reasons why a mutant cannot be tried, or was not caught."""
    count = (ROOT / PACKAGE / mutant.file).read_text().count(mutant.text)
    file, _, test = mutant.test.partition("::")
    exists = (ROOT / file).is_file() and f"def {test}(" in (ROOT / file).read_text()
    return [
        *([] if count == 1 else [f"its text occurs {count} times"]),
        *(["it changes nothing"] if mutant.instead == mutant.text else []),
        *([] if exists else [f"no test {mutant.test}"]),
        *(["not caught: python3 study.py mutations"] if mutant.tried in ("", SURVIVED) else []),
    ]


def test_every_mutant_changes_one_place_and_was_caught_by_a_test_that_exists():
    assert not {mutant.mutant: faults for mutant in MUTANTS if (faults := faults_of(mutant))}
    assert len({mutant.mutant for mutant in MUTANTS}) == len(MUTANTS)


def test_every_stage_has_a_mutant():
    assert {Path(mutant.file).parent.as_posix() for mutant in MUTANTS} == STAGES


def test_a_mutant_with_a_fault_is_listed():
    file, text = MUTANTS[0].file, MUTANTS[0].text
    faults = faults_of(Mutant("x", file, text + "?", text + "?", "tests/nowhere.py::test"))
    assert [fault.split()[0] for fault in faults] == ["its", "it", "no", "not"]


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A project of one kernel, whose test fails if it is wrong, and a table of mutants that changes it."""
    kernel = tmp_path / PACKAGE / "kernel.py"
    kernel.parent.mkdir(parents=True)
    kernel.write_text("right")
    monkeypatch.setattr(mutations, "passes", lambda project, *tests: kernel.read_text() != "wrong")
    return tmp_path


def test_survivors_are_told_from_mutants_that_are_caught(project):
    mutants = [Mutant(name, "kernel.py", "right", name, "test") for name in ("wrong", "harmless")]
    caught, survivor = mutations.tried(project, mutants)
    assert (caught.tried != SURVIVED, survivor.tried) == (True, SURVIVED)
    assert [file.read_text() for file in (project / PACKAGE).iterdir()] == ["right"]
    with pytest.raises(MutationError, match="has 'left' 0 times"):
        list(mutations.tried(project, [Mutant("x", "kernel.py", "left", "wrong", "test")]))
    (project / PACKAGE / "kernel.py").write_text("wrong")
    with pytest.raises(MutationError, match="fails without a mutant"):
        list(mutations.tried(project, mutants))


def test_the_table_is_written_as_it_is_read(tmp_path):
    mutations.write_mutants(MUTANTS, tmp_path / "table.tsv")
    assert (tmp_path / "table.tsv").read_text() == mutations.TABLE.read_text()


def test_a_mutant_that_is_not_listed_is_refused():
    with pytest.raises(SystemExit, match="no mutant older"):
        mutations.main(["older"])
