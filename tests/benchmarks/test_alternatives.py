"""The competing methods: pooled coverage; hearts in 3-D are problems like those of the spheres."""

import numpy as np

from benchmarks.alternatives import HEARTS, ROOT, SETTING, pooled
from heartfit.io.configuration import read_cases, read_study
from heartfit.results.race import sphere_coverage_table
from heartfit.synthetic.race import Coverage


def test_coverage_is_pooled_over_the_parameters() -> None:
    shares = sphere_coverage_table({"volume": [Coverage("nothing", "R = 0", ("sigma_0",), np.zeros((8, 1)))]})
    (row,) = pooled(shares).to_dict("records")
    assert (row["measured"], row["unknown"], row["noise"]) == ("volume", "nothing", "R = 0")
    assert row["covered (%)"] == 100.0


def test_the_hearts_in_3d_are_volunteers_of_the_study() -> None:
    study = read_study([ROOT / "config" / "config.yaml"])
    cases = {case.case: case for case in read_cases(ROOT / study.cases)}
    assert all(cases[name].kind == "virtual" and not cases[name].catheter for name in HEARTS)
    assert SETTING in study.settings
