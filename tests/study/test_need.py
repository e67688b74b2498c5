"""Needs of a kind of job, from the measured costs of its jobs."""

import pytest

from heartfit.study.need import Cost, largest, needs

COSTS = [
    Cost("compile_kernels", 33.0, 14.0, 335.0),
    Cost("templates/generator", 14.0, 10.0, 300.0),
    Cost("registration_error/baseline/try_7", 9.0, 8.0, 416.0),
    Cost("volunteer1/generate_volunteer", 12.0, 11.0, 527.0),
    Cost("volunteer1/locking/simulate_point_0", 4.0, 3.0, 270.0),
    Cost("volunteer1/locking/simulate_point_10", 6.0, 3.0, 300.0),
    Cost("volunteer1/locking/simulate_point_2", 5.0, 3.0, 280.0),
    Cost("patient1/locking/simulate_point_0", 16.0, 9.0, 426.4),
    Cost("patient1/locking/try_mechanism_SeptalLoad", 50.0, 45.0, 390.0),
]


def rows():
    return {(row.job, row.kind): row for row in needs(COSTS)}


def test_the_path_of_a_job_determines_unit_and_kind():
    rows_by_job = {key: (row.per, row.number) for key, row in rows().items()}
    assert rows_by_job == {
        ("compile_kernels", ""): ("study", 1),
        ("build_template", ""): ("study", 1),
        ("try", ""): ("study", 1),
        ("generate_volunteer", "virtual"): ("case", 1),
        ("simulate_point", "virtual"): ("point", 3),
        ("simulate_point", "measured"): ("point", 1),
        ("try_mechanism", "measured"): ("setting", 1),
    }


def test_the_share_of_a_job_relates_to_the_most_common_job():
    costs = [Cost(f"heart{n}/plot_case", 1.0, 1.0, 1.0) for n in range(4)]
    rows_by_job = {row.job: row.share for row in needs([*costs, Cost("heart0/register_cine", 1.0, 1.0, 1.0)])}
    assert rows_by_job == {"plot_case": 1.0, "register_cine": 0.25}


def test_a_row_holds_the_median_and_the_largest():
    row = rows()["simulate_point", "virtual"]
    assert (row.typical_s, row.longest_s, row.memory_mb) == (5.0, 6.0, 300.0)


def test_requests_cover_every_subject_with_a_margin_for_snakemake():
    need = largest(needs(COSTS), "simulate_point")
    assert need.megabytes() == 1200  # 1.3 x 426.4 + 600, up to whole hundreds
    assert need.minutes() == 2  # 3 x 16 s is not one minute
    assert largest(needs(COSTS), "try_mechanism").minutes() == 4


def test_a_job_that_was_never_measured_has_no_needs():
    with pytest.raises(KeyError, match="dance"):
        largest(needs(COSTS), "dance")


def test_jobs_on_request_are_no_part_of_every_study():
    usual = {key[0] for key, row in rows().items() if row.usual}
    assert "try_mechanism" not in usual
    assert "try" not in usual, "the noise model is stored"
    assert {"generate_volunteer", "simulate_point", "compile_kernels"} <= usual
