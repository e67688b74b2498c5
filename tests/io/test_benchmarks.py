"""Benchmarks of Snakemake are read as written; a file that is no benchmark is named."""

from pathlib import Path

import pytest

from heartfit.core.errors import InputError
from heartfit.io.campaign import read_benchmarks
from heartfit.study.need import Cost

HEADER = "s\th:m:s\tmax_rss\tmax_vms\tmax_uss\tmax_pss\tio_in\tio_out\tmean_load\tcpu_time\n"


def test_jobs_are_named_by_their_files_and_one_too_short_to_be_sampled_has_no_memory(tmp_path: Path) -> None:
    (tmp_path / "case").mkdir()
    sampled = "9.44\t0:00:09\t205.88\t498.43\t98.46\t116.71\t0.00\t0.50\t28.14\t2.85\n"
    short = "0.31\t0:00:00\tNA\tNA\tNA\tNA\tNA\tNA\tNA\tNA\n"
    (tmp_path / "case" / "build_mesh.tsv").write_text(HEADER + sampled)
    (tmp_path / "quick.tsv").write_text(HEADER + short)
    expected = [Cost("case/build_mesh", 9.44, 2.85, 205.88), Cost("quick", 0.31, 0.0, 0.0)]
    assert read_benchmarks(tmp_path) == expected


def test_a_folder_without_benchmarks_and_an_unrelated_table_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no benchmark of a job"):
        read_benchmarks(tmp_path)
    (tmp_path / "other.tsv").write_text("a\tb\n1\t2\n")
    with pytest.raises(
        InputError, match=r"other\.tsv: no benchmark; expected the columns cpu_time, max_rss, s"
    ):
        read_benchmarks(tmp_path)
