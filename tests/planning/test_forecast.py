"""A forecast is what was measured, as often as it will be."""

from heartfit.planning.footprint import Footprint, footprints, place_of
from heartfit.planning.forecast import Subjects, each, forecast, whole
from heartfit.planning.need import Need
from heartfit.planning.page import forecast_page

ROWS = [
    Need("compile_kernels", "study", "", 1, 1.0, 30.0, 30.0, 300.0),
    Need("draw_volunteer", "study", "", 4, 4.0, 5.0, 9.0, 300.0),
    Need("build_mesh", "case", "measured", 1, 1.0, 28.0, 28.0, 200.0),
    Need("build_mesh", "case", "virtual", 2, 1.0, 2.0, 3.0, 200.0),
    Need("compare_case", "setting", "virtual", 4, 1.0, 1.0, 1.0, 200.0),
    Need("plot_overlay", "setting", "virtual", 1, 0.25, 4.0, 4.0, 200.0),
    Need("simulate_point", "point", "virtual", 36, 1.0, 6.0, 9.0, 200.0),
    Need("prove_cause", "setting", "virtual", 4, 1.0, 900.0, 900.0, 200.0),
]
PRINTS = [Footprint("study", "", 100, 10.0), Footprint("point", "virtual", 4, 0.5)]
SUBJECTS = Subjects(100, "virtual", 2, 18)


def test_each_level_is_counted_as_often_as_it_will_be():
    parts = {part.per: part for part in forecast(ROWS, PRINTS, SUBJECTS)}
    assert (parts["study"].jobs, parts["study"].seconds) == (5, 50.0)
    assert (parts["case"].jobs, parts["case"].seconds) == (100, 200.0)
    assert (parts["point"].jobs, parts["point"].seconds) == (1800, 10800.0)
    assert (parts["point"].files, parts["point"].megabytes) == (7200, 900.0)


def test_what_only_some_cases_had_is_counted_by_its_share_and_what_is_asked_for_not_at_all():
    setting = next(part for part in forecast(ROWS, PRINTS, SUBJECTS) if part.per == "setting")
    assert (setting.jobs, setting.seconds) == (200 + 50, 200.0 + 200.0)


def test_a_subject_adds_what_the_study_does_not_have_once():
    parts = forecast(ROWS, PRINTS, SUBJECTS)
    assert whole(parts).jobs == 5 + 100 * each(parts, SUBJECTS).jobs
    assert each(parts, SUBJECTS).jobs == 1 + 2.5 + 18


def test_the_page_says_the_sum_and_the_days():
    page = forecast_page(forecast(ROWS, PRINTS, SUBJECTS), SUBJECTS, 10)
    assert page.startswith("100 virtual subjects, 2 settings, 18 sigma points each\n")
    assert "| all | 2155 | 3.18 | 7300 | 0.91 |" in page
    assert "0.0133 days on 10 CPUs." in page


def test_files_belong_to_what_their_name_says():
    kinds, settings = {"leak1": "virtual", "mine": "measured"}, {"paper"}
    places = {
        "kernels.json": ("study", ""),
        "sensitivity/paper/beats/3.json": ("study", ""),
        "leak1/images/cine.nrrd": ("case", "virtual"),
        "figures/mine_paper_shape.png": ("setting", "measured"),
        "tables/mine_cine_wall.csv": ("case", "measured"),
        "leak1/paper/calibration/beats/12.csv": ("point", "virtual"),
        "logs/leak1/paper/simulate_point_12.log": ("point", "virtual"),
    }
    assert {name: place_of(name, kinds, settings) for name in places} == places


def test_footprints_are_means_over_what_there_was():
    beats = [(f"{case}/paper/calibration/beats/{n}.json", 1000) for case in ("a1", "a2") for n in range(9)]
    logs = [(f"logs/{case}/paper/simulate_point_{n}.log", 500) for case in ("a1", "a2") for n in range(9)]
    found = footprints([*beats, *logs, ("kernels.json", 10)], {"a1": "virtual", "a2": "virtual"}, {"paper"})
    assert found == [Footprint("point", "virtual", 2.0, 0.0015), Footprint("study", "", 1.0, 1e-5)]
