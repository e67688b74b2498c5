"""The costs of a study: every job in its stage, sums that add up, and the paper's time beside them."""

import pytest

from heartfit.results.costs import OTHER_STAGE, WHOLE_STUDY, Cost, cost_table, plot_costs, stage_of

COSTS = [
    Cost("volunteer1/locking/simulate_point_0", 60.0, 55.0, 300.0),
    Cost("volunteer1/locking/simulate_point_10", 40.0, 38.0, 320.0),
    Cost("templates/generator", 8.0, 7.0, 250.0),
    Cost("make_tables", 0.0, 0.0, 0.0),
]


STAGES = {
    "compile_kernels": "kernels",
    "templates/calibrator": "meshes",
    "patient1/build_mesh": "meshes",
    "lbbb1/record_pressure": "true beats",
    "volunteer3/image_volunteer": "images",
    "patient1/register_cine": "registration",
    "lbbb2/physical/simulate_point_14": "calibration",
    "lbbb2/physical/simulate_calibrated": "calibration",
    "sensitivity/locking/simulate_surroundings": "sensitivity",
    "registration_error/baseline/try_7": "registration error",
    "cover_spheres": "spheres",
    "volunteer1/locking/plot_case": OTHER_STAGE,
    "make_tables": OTHER_STAGE,
}
"""Stage of a job by its name."""


def test_a_job_belongs_to_the_stage_of_its_name() -> None:
    assert {job: stage_of(job) for job in STAGES} == STAGES


def test_stages_are_summed_from_the_dearest_and_the_paper_stands_beside_them() -> None:
    table = cost_table(COSTS).set_index("stage")
    assert list(table.index) == ["calibration", "meshes", OTHER_STAGE, WHOLE_STUDY]
    assert table.loc["calibration"].tolist() == pytest.approx(
        [2, 100.0, 93.0, 100.0 / 1.08, 320.0, 100.0 / 108.0]
    )
    assert table.loc[WHOLE_STUDY, "jobs"] == len(COSTS)
    assert table.loc[WHOLE_STUDY, "wall (s)"] == pytest.approx(108.0)
    assert table.loc[WHOLE_STUDY, "of the paper's 9 x 20 min (%)"] == pytest.approx(1.0)


def test_the_figure_has_two_bars_for_each_stage() -> None:
    table = cost_table(COSTS)
    axes = plot_costs(table).axes[0]
    assert sorted(bar.get_width() for bar in axes.patches) == pytest.approx(
        sorted([*table["wall (s)"][:-1] / 60.0, *table["CPU (s)"][:-1] / 60.0])
    )
