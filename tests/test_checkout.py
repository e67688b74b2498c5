"""A copy of the project finds the compiled kernels of the project and leaves out data and caches."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.checkout import PACKAGE, PARTS, copy_project, environment_of, folder_of_kernels, kernels_of
from tests.faults.tiny import RESULTS, TinyStudy


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project of one compiled kernel, with kernels of an older source and a measured heart beside it."""
    root = tmp_path / "project"
    for part in PARTS[1:]:
        (root / part).mkdir(parents=True)
    (root / PARTS[0]).write_text("rule all:\n")
    kernel = root / PACKAGE / "sphere" / "beat.py"
    kernel.parent.mkdir(parents=True)
    kernel.write_text("import numba\nbeat = 1\n")
    os.utime(kernel, ns=(10**18 + 123, 10**18 + 123))
    compiled = kernels_of(root / PACKAGE, kernel.parent)
    old = compiled.parent.with_name("kernels-old") / compiled.name
    for folder in (compiled, old, root / "resources" / "bivme_patient1"):
        folder.mkdir(parents=True)
        (folder / "one.nbi").write_text("code")
    return root


def test_a_copy_has_the_compiled_kernels_of_its_sources_and_no_others(project: Path, tmp_path: Path) -> None:
    copy_project(tmp_path / "copy", project)
    package = tmp_path / "copy" / PACKAGE
    assert (kernels_of(package, package / "sphere") / "one.nbi").read_text() == "code"
    assert len(list((tmp_path / "copy").rglob("*.nbi"))) == 1
    assert sorted(path.name for path in (tmp_path / "copy").iterdir()) == sorted(
        {Path(part).parts[0] for part in PARTS}
    )


def test_a_project_without_compiled_kernels_is_copied(project: Path, tmp_path: Path) -> None:
    (project / PACKAGE / "sphere" / "beat.py").write_text("import numba\nbeat = 22\n")
    copy_project(tmp_path / "copy", project)
    assert not list((tmp_path / "copy").rglob("*.nbi"))


def test_a_study_copies_results_with_their_snakemake_metadata(tmp_path: Path) -> None:
    root, study = tmp_path / "root", TinyStudy.__new__(TinyStudy)
    study.folder = tmp_path / "study"
    study.adopt(root)
    assert not study.folder.exists()
    for file in (f"{RESULTS}/tables/numbers.csv", ".snakemake/metadata/abc", ".snakemake/locks/0"):
        (root / file).parent.mkdir(parents=True)
        (root / file).write_text(file)
    study.adopt(root)
    assert set(study.sums()) == {"tables/numbers.csv"}
    assert (study.folder / ".snakemake" / "metadata" / "abc").is_file()
    assert not (study.folder / ".snakemake" / "locks").exists()


def test_a_copied_kernel_is_not_compiled_again(tmp_path: Path) -> None:
    """numba counts a hit of its cache where the copy runs, and none where the source is another."""
    root = tmp_path / "root"
    for part in PARTS[1:]:
        (root / part).mkdir(parents=True)
    (root / PARTS[0]).touch()
    source = root / PACKAGE / "sphere" / "beat.py"
    source.parent.mkdir(parents=True)
    source.write_text("from numba import njit\n\n\n@njit(cache=True)\ndef beat(x):\n    return x + 1.0\n")
    assert hits(root, 1.0) == "2.0 0"
    copy_project(tmp_path / "copy", root)
    assert hits(tmp_path / "copy", 1.0) == "2.0 1"
    copied = tmp_path / "copy" / PACKAGE / "sphere" / "beat.py"
    copied.write_text(copied.read_text().replace("1.0", "10.0"))
    assert hits(tmp_path / "copy", 1.0) == "11.0 0"


def hits(root: Path, x: float) -> str:
    """Value of the kernel and cache hits of numba, in a separate process."""
    package = root / PACKAGE
    program = f"from beat import beat; print(beat({x}), sum(beat.stats.cache_hits.values()))"
    places = {"PYTHONPATH": str(package / "sphere"), "NUMBA_CACHE_DIR": str(folder_of_kernels(package))}
    command = [sys.executable, "-c", program]
    return subprocess.run(
        command, env=environment_of(root) | places, capture_output=True, text=True, check=True
    ).stdout.strip()


def test_a_copy_runs_with_kernels_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", "elsewhere")
    environment = environment_of(tmp_path)
    assert "NUMBA_CACHE_DIR" not in environment
    assert environment["PYTHONPATH"] == str(tmp_path / "src")
