"""Sensitivities, selections, priors and indices, printed and drawn with the numbers they hold."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.plausible import End, Plausible, PlausibleRange
from heartfit.calibration.sensitivity import Sensitivity
from heartfit.calibration.sobol import SobolIndices
from heartfit.heart.heart import PAPER_PARAMETERS
from heartfit.io.figures import write_figure
from heartfit.observation.curve import Curve
from heartfit.results.colours import setting_colours
from heartfit.results.figures import plot_perturbations
from heartfit.results.parameters import prior_table
from heartfit.results.sensitivity import (
    FOUR,
    SEVEN,
    bulk_modulus_table,
    plot_sensitivities,
    plot_sobol,
    selection_table,
    sensitivity_table,
    sobol_table,
)
from tests.printed import numbers_in

OBSERVED = ("V_min", "q_max", "q_min", "P_max", "dPdt_max", "dPdt_min")
N, M = len(PAPER_PARAMETERS), len(OBSERVED)


def sensitivity() -> Sensitivity:
    """The paper's four drive one observation each, the rest next to nothing; c_1 repeats sigma_0."""
    prior = Gaussian.from_relative(dict.fromkeys(PAPER_PARAMETERS, 1e3), dict.fromkeys(PAPER_PARAMETERS, 0.2))
    slopes = 0.01 * np.random.default_rng(0).standard_normal((N, M))
    for column, name in enumerate(("sigma_0", "mu", "R_p", "k_RS", "k_ATP", "alpha")):
        slopes[PAPER_PARAMETERS.index(name), column] = 1.0
    slopes[PAPER_PARAMETERS.index("c_1")] = 0.9 * slopes[PAPER_PARAMETERS.index("sigma_0")]
    scale = np.linalg.norm(slopes, axis=0)
    return Sensitivity(prior, OBSERVED, np.ones(M), slopes / scale, slopes / 0.2)


def ranges() -> Plausible:
    intervals = [PlausibleRange(name, 1e3, End(0.5, "EF"), End(2.0, "cap")) for name in PAPER_PARAMETERS]
    return Plausible(tuple(intervals), ("dPdt_min",))


def indices() -> SobolIndices:
    total = sensitivity().covariance ** 2
    total[PAPER_PARAMETERS.index("K")] = 0.0
    return SobolIndices(
        PAPER_PARAMETERS, OBSERVED, 0.9 * total, total, 0.1 * total, 0.1 * total, 64, ("cold",)
    )


def test_a_row_of_sensitivities_holds_prior_covariance_and_shares() -> None:
    table = sensitivity_table(sensitivity(), dict.fromkeys(PAPER_PARAMETERS, "Pa")).set_index("parameter")
    assert table["mean"]["mu"] == pytest.approx(1.0)  # kPa
    assert table["sd (%)"]["mu"] == pytest.approx(20.0)
    assert table["q_max"]["mu"] == pytest.approx(1.0, abs=0.01)
    assert table[["volume (%)", "all (%)"]].sum().tolist() == pytest.approx([100.0, 100.0])


def test_sensitivity_to_the_bulk_modulus_is_in_per_cent_per_per_cent() -> None:
    whole = sensitivity()
    table = bulk_modulus_table({"locking": whole}, {"K": "Pa"})
    assert table["K (kPa)"].tolist() == pytest.approx([1.0])
    assert table["V_min"].tolist() == [whole.slopes[PAPER_PARAMETERS.index("K"), 0]]


def test_the_rule_prefers_what_is_independent_and_sets_are_ranked() -> None:
    sensitivities, plausible = {"physical": sensitivity()}, {"physical": ranges()}
    table = selection_table(sensitivities, plausible, {"physical": (FOUR, SEVEN)})
    rule = table[table["chosen by"] == "rule"]
    assert rule["parameters"].iloc[0] == "R_p, mu, sigma_0, c_1"
    assert set(rule["parameters"].iloc[1].split(", ")) >= {"k_RS", "k_ATP", "alpha"}
    paper = table[table["chosen by"] == "Marchesseau et al. 2012"]
    assert paper["parameters"].tolist() == [", ".join(FOUR), ", ".join(SEVEN)]
    assert paper["volume of Z (%)"].iloc[1] < 1.0, "no other parameter acts as alpha does"
    assert rule["place by volume"].iloc[1] == "1 of 3432"


def test_fewer_parameters_than_observations_have_no_volume() -> None:
    """Its determinant is zero up to rounding, which would decide the place among sets that all have none."""
    table = selection_table(
        {"physical": sensitivity()}, {"physical": ranges()}, {"physical": (FOUR[:2], SEVEN[:5])}
    )
    ours = table[table["chosen by"] == "this study"]
    assert ours["volume of Z (%)"].isna().all()
    assert set(ours["place by volume"]) == {""}
    assert (ours["squares (%)"] > 0.0).all()


def test_the_paper_is_left_out_where_its_parameters_are_not_studied() -> None:
    whole = sensitivity()
    kept = [index for index, name in enumerate(PAPER_PARAMETERS) if name != "K"]
    names = tuple(PAPER_PARAMETERS[index] for index in kept)
    prior = Gaussian.from_relative(dict.fromkeys(names, 1e3), dict.fromkeys(names, 0.2))
    part = Sensitivity(prior, OBSERVED, whole.centre, whole.covariance[kept], whole.slopes[kept])
    own = (("sigma_0", "mu", "c_1", "R_p"), names[:7])
    table = selection_table(
        {"physical": part}, {"physical": Plausible(ranges().ranges[:13], ())}, {"physical": own}
    )
    assert "Marchesseau et al. 2012" not in set(table["chosen by"])


def test_the_prior_of_the_rule_stands_beside_the_one_in_use() -> None:
    table = prior_table(
        {"physical": ranges()}, {"physical": sensitivity()}, dict.fromkeys(PAPER_PARAMETERS, "Pa")
    )
    row = table[table["parameter"] == "mu"].iloc[0]
    assert (row["lowest"], row["highest"], row["X0"], row["X0 used"]) == pytest.approx((0.5, 2.0, 1.0, 1.0))
    assert row["sd (%)"] == pytest.approx(50 * np.log(2.0))
    assert (row["stopped by"], row["and by"]) == ("EF", "cap")
    assert row["off (sd)"] == pytest.approx(0.0)
    assert table["parameter"].iloc[-1] == "not kept: dPdt_min"


def test_sobol_indices_of_a_sphere_have_no_bulk_modulus_and_list_lost_points() -> None:
    table = sobol_table(indices()).set_index("parameter")
    assert table["q_max T (%)"]["mu"] == pytest.approx(100.0, abs=2)
    assert "incompressible" in table["note"]["K"]
    assert numbers_in(table["note"]["beats"]) == [1024.0, 64.0, 1.0]


def test_figures_are_drawn(tmp_path: Path) -> None:
    example = sensitivity()
    heat = plot_sensitivities(example, "volunteer1, physical setting")
    assert len(heat.axes[1].patches) == 4
    assert len(heat.axes[2].patches) == 7
    colours = setting_colours(["other", "locking", "physical"])
    bars = plot_sobol(indices(), {"locking": example, "physical": example}, colours)
    drawn = [line.get_color() for line in bars.axes[0].lines if line.get_label().startswith("mesh")]
    assert drawn == [colours["locking"], colours["physical"]]
    write_figure(tmp_path / "heat.png", heat)
    write_figure(tmp_path / "sobol.pdf", bars)


def test_a_failed_beat_is_left_out_of_the_curves() -> None:
    time = np.linspace(0.0, 0.8, 40, endpoint=False)
    wave = Curve(time, 1e-4 + 4e-5 * np.cos(2 * np.pi * time / 0.8), 0.8)
    whole = {"lv_volume": wave, "lv_pressure": wave}
    labels = ["centre", *(f"{name}{sign}" for name in PAPER_PARAMETERS[:9] for sign in "+-")]
    curves = dict.fromkeys(labels, whole) | {"k_0+": {}}
    figure = plot_perturbations(curves, PAPER_PARAMETERS[:9], "volunteer1", 1.0)
    assert [len(figure.axes[column].lines) for column in range(7)] == [3, 3, 3, 2, 3, 3, 3]
    assert sum(axes.get_visible() for axes in figure.axes) == 18
