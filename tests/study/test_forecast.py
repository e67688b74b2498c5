"""Forecasts multiply measured costs by numbers of units."""

import pytest

from heartfit.study.forecast import (
    Footprint,
    Subjects,
    chain_seconds,
    footprints,
    forecast,
    forecast_page,
    part_per_subject,
    total_of,
    unit_of,
    wall_seconds,
)
from heartfit.study.need import Need
from tests.printed import numbers_in, rows_of

ROWS = [
    Need("compile_kernels", "study", "", 1, 1.0, 30.0, 30.0, 300.0),
    Need("build_template", "study", "", 4, 4.0, 5.0, 9.0, 300.0),
    Need("build_mesh", "case", "measured", 1, 1.0, 28.0, 28.0, 200.0),
    Need("build_mesh", "case", "virtual", 2, 1.0, 2.0, 3.0, 200.0),
    Need("compare_case", "setting", "virtual", 4, 1.0, 1.0, 1.0, 200.0),
    Need("plot_overlay", "setting", "virtual", 1, 0.25, 4.0, 4.0, 200.0),
    Need("simulate_point", "point", "virtual", 36, 1.0, 6.0, 9.0, 200.0),
    Need("prove_cause", "setting", "virtual", 4, 1.0, 900.0, 900.0, 200.0),
]
PRINTS = [Footprint("study", "", 100, 10.0), Footprint("point", "virtual", 4, 0.5)]
SUBJECTS = Subjects(100, "virtual", 2, 18)


def test_parts_multiply_with_the_number_of_their_units():
    parts = {part.per: part for part in forecast(ROWS, PRINTS, SUBJECTS)}
    assert (parts["study"].jobs, parts["study"].seconds) == (5, 50.0)
    assert (parts["case"].jobs, parts["case"].seconds) == (100, 200.0)
    assert (parts["point"].jobs, parts["point"].seconds) == (1800, 10800.0)
    assert (parts["point"].files, parts["point"].megabytes) == (7200, 900.0)


def test_optional_parts_of_cases_count_with_their_share_and_jobs_on_request_not_at_all():
    setting = next(part for part in forecast(ROWS, PRINTS, SUBJECTS) if part.per == "setting")
    assert (setting.jobs, setting.seconds) == (200 + 50, 200.0 + 200.0)


def test_a_subject_adds_all_parts_except_those_of_the_study():
    parts = forecast(ROWS, PRINTS, SUBJECTS)
    assert total_of(parts).jobs == 5 + 100 * part_per_subject(parts, SUBJECTS).jobs
    assert part_per_subject(parts, SUBJECTS).jobs == 1 + 2.5 + 18


def test_a_chain_has_one_job_of_each_kind_and_none_on_request():
    assert chain_seconds(ROWS, "virtual") == 30.0 + 5.0 + 2.0 + 1.0 + 4.0 + 6.0
    assert chain_seconds(ROWS, "measured") == 30.0 + 5.0 + 28.0


def test_the_time_on_many_cpus_ends_at_the_chain():
    assert wall_seconds(1000.0, 48.0, 1) == 1000.0
    assert wall_seconds(1000.0, 48.0, 2) == 500.0 + 24.0
    assert wall_seconds(1000.0, 48.0, 10**6) == pytest.approx(48.0, rel=1e-4)


def test_the_page_states_total_and_days():
    page = forecast_page(forecast(ROWS, PRINTS, SUBJECTS), SUBJECTS, 10)
    assert numbers_in(page.splitlines()[0]) == [100.0, 2.0, 18.0]
    assert rows_of(page)["all"] == ["2155", "3.18", "7300", "0.91"]
    assert [0.0133, 10.0] in [numbers_in(line) for line in page.splitlines()]


def test_paths_determine_unit_and_kind_of_subject():
    kinds, settings = {"leak1": "virtual", "mine": "measured"}, {"locking"}
    places = {
        "kernels.json": ("study", ""),
        "sensitivity/locking/beats/3.json": ("study", ""),
        "leak1/images/cine.nrrd": ("case", "virtual"),
        "figures/mine_locking_shape.png": ("setting", "measured"),
        "tables/mine_cine_wall.csv": ("case", "measured"),
        "leak1/locking/calibration/beats/12.csv": ("point", "virtual"),
        "logs/leak1/locking/simulate_point_12.log": ("point", "virtual"),
    }
    assert {name: unit_of(name, kinds, settings) for name in places} == places


def test_footprints_are_means_over_units():
    beats = [(f"{case}/locking/calibration/beats/{n}.json", 1000) for case in ("a1", "a2") for n in range(9)]
    logs = [(f"logs/{case}/locking/simulate_point_{n}.log", 500) for case in ("a1", "a2") for n in range(9)]
    averages = footprints(
        [*beats, *logs, ("kernels.json", 10)], {"a1": "virtual", "a2": "virtual"}, {"locking"}
    )
    assert averages == [Footprint("point", "virtual", 2.0, 0.0015), Footprint("study", "", 1.0, 1e-5)]
