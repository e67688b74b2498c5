"""Page of the competing methods: all rows of its tables; hearts in 3-D are problems like those of the spheres."""

import numpy as np

from benchmarks.alternatives import HEARTS, ROOT, SETTING
from benchmarks.alternatives_page import page
from heartfit.io.configuration import read_cases, read_study
from heartfit.results.race import race_table, sphere_coverage_table
from heartfit.synthetic.race import Coverage, MethodScore


def test_the_page_has_every_method_and_every_noise() -> None:
    race = race_table({"volume": [MethodScore(0, "unscented, R = 0", 9, 2.5, 0.5)]})
    shares = sphere_coverage_table({"volume": [Coverage("nothing", "R = 0", ("sigma_0",), np.zeros((8, 1)))]})
    study = read_study([ROOT / "config" / "config.yaml"]).sphere_study
    text = page(race, shares, study)
    assert f"{study.covered} spheres" in text
    assert "| volume     | unscented, R = 0 | 9" in text
    assert "| volume     | nothing   | R = 0   | 100.0 " in text
    assert "{" not in text


def test_the_hearts_in_3d_are_volunteers_of_the_study() -> None:
    study = read_study([ROOT / "config" / "config.yaml"])
    cases = {case.case: case for case in read_cases(ROOT / study.cases)}
    assert all(cases[name].kind == "virtual" and not cases[name].catheter for name in HEARTS)
    assert SETTING in study.settings
