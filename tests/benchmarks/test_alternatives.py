"""The coverage that is stored is the one over all parameters."""

import numpy as np

from benchmarks.alternatives import pooled
from heartfit.results.race import sphere_coverage_table
from heartfit.synthetic.race import Coverage


def test_coverage_is_pooled_over_the_parameters() -> None:
    shares = sphere_coverage_table({"volume": [Coverage("nothing", "R = 0", ("sigma_0",), np.zeros((8, 1)))]})
    (row,) = pooled(shares).to_dict("records")
    assert (row["measured"], row["unknown"], row["noise"]) == ("volume", "nothing", "R = 0")
    assert row["covered (%)"] == 100.0
