"""Measured costs are read back as written."""

from pathlib import Path

import pytest

from heartfit.core.errors import InputError
from heartfit.io.campaign import as_table, measured_footprints, measured_needs, read_table
from heartfit.study.forecast import Footprint
from heartfit.study.need import Need

HEADER = "s\tmax_rss\tcpu_time\n"


def study(folder: Path, **seconds: float) -> Path:
    for job, wall in seconds.items():
        file = folder / "benchmarks" / f"{job.replace('__', '/')}.tsv"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(f"{HEADER}{wall}\t200.0\t{wall}\n")
    return folder


def test_a_job_run_by_several_studies_counts_in_the_first(tmp_path):
    first = study(tmp_path / "first", compile_kernels=3.0, heart1__build_mesh=5.0)
    second = study(tmp_path / "second", compile_kernels=9.0, make_tables=1.0)
    typical = {row.job: row.typical_s for row in measured_needs([first, second])}
    assert typical == {"build_mesh": 5.0, "compile_kernels": 3.0, "make_tables": 1.0}


def test_files_are_counted_by_case_and_setting(tmp_path):
    results = study(tmp_path, heart1__build_mesh=5.0, heart1__locking__compare_case=1.0)
    counts = {(footprint.per, footprint.kind): footprint.files for footprint in measured_footprints(results)}
    assert counts == {("case", "measured"): 1.0, ("setting", "measured"): 1.0}


def test_sums_are_files_of_what_they_are_sums_of(tmp_path):
    results = study(tmp_path, heart1__build_mesh=5.0, heart1__locking__compare_case=1.0)
    for beat in ("0.json", "1.json"):
        for folder in (results, results / ".sums"):
            file = folder / "heart1" / "locking" / "calibration" / "beats" / beat
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text("{}")
    counts = {(footprint.per, footprint.kind): footprint.files for footprint in measured_footprints(results)}
    assert counts["point", "measured"] == 2.0


def test_files_of_another_study_within_the_folder_do_not_count(tmp_path):
    results = study(tmp_path, heart1__build_mesh=5.0)
    other = study(tmp_path / "other", heart2__build_mesh=5.0)
    beat = other / "heart2" / "locking" / "calibration" / "beats" / "0.json"
    beat.parent.mkdir(parents=True)
    beat.write_text("{}")
    counts = {(footprint.per, footprint.kind): footprint.files for footprint in measured_footprints(results)}
    assert counts == {("case", "measured"): 1.0}


def test_a_table_is_read_as_it_was_written(tmp_path):
    rows = [Need("build_mesh", "case", "virtual", 9, 1.0, 2.33, 3.78, 208.7)]
    (tmp_path / "costs.tsv").write_text(as_table(Need, rows))
    assert read_table(Need, tmp_path / "costs.tsv") == rows


def test_an_unrelated_table_and_a_missing_one_are_refused_in_one_line(tmp_path):
    with pytest.raises(InputError, match=r"costs\.tsv: no such file; expected measured costs"):
        read_table(Need, tmp_path / "costs.tsv")
    (tmp_path / "costs.tsv").write_text(as_table(Footprint, [Footprint("study", "", 3.0, 1.0)]))
    with pytest.raises(
        InputError, match=r"costs\.tsv: not the costs that were measured; expected the columns job"
    ):
        read_table(Need, tmp_path / "costs.tsv")
