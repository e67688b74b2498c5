"""Errors of registration, from comparisons with known errors: rows, columns, signs, units and figures."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.io.figures import write_figure
from heartfit.observation.comparison import Comparison
from heartfit.observation.curve import Curve
from heartfit.observation.operator import Pair, Reading, VolumeFeatures
from heartfit.results.acquisitions import Acquisitions
from heartfit.results.registration import plot_registration, registration_table, segment_table
from heartfit.results.text import to_latex, to_markdown

PHASES, PERIOD = 12, 0.8
TIMES = np.arange(PHASES) * PERIOD / PHASES
WAVE = np.sin(np.pi * np.arange(PHASES) / PHASES) ** 2  # end systole in phase 6
FEATURES = VolumeFeatures(frames=PHASES)


def reading(stroke: float) -> Reading:
    curve = Curve(TIMES, 120e-6 - stroke * WAVE, PERIOD)
    return Reading.from_curves({"lv_volume": curve}, {"lv_volume": FEATURES})


def comparison(shrinkage: float, strain: float = 0.01, folded: int = 0) -> Comparison:
    """A stroke of 60 mL of which a share is lost; strains wrong by ``strain``, twice and three times that."""
    true = np.zeros((PHASES, 3, 16)) - 0.2 * WAVE[:, None, None]
    error = strain * WAVE[:, None, None] * np.array([1.0, -2.0, 3.0])[:, None]
    points = np.outer(WAVE, [1e-3, 2e-3])
    folds = np.where(np.arange(PHASES) == 4, folded, 0)
    pair = Pair(reading(60e-6), reading((1.0 - shrinkage) * 60e-6))
    return Comparison(pair, true, true + error, points, np.array([0.5e-3, 1.5e-3]), folds)


@pytest.fixture
def acquisitions() -> Acquisitions:
    return Acquisitions(
        settings={"SNR": 30.0, "frames": 12.0},
        baseline=[comparison(0.1), comparison(-0.1, folded=3)],
        varied={"SNR": {50.0: [comparison(0.05)], 10.0: [comparison(0.3, strain=-0.02)]}, "frames": {}},
    )


def test_each_protocol_has_a_row_and_what_was_published_stands_below(acquisitions: Acquisitions) -> None:
    table = registration_table(acquisitions).set_index("acquisition")
    assert list(table.index[:3]) == ["baseline", "SNR 10", "SNR 50"]
    assert table.loc["baseline", "sequences"] == 2
    assert table.loc["Marchesseau et al. 2012", ["q_max (%)", "q_min (%)"]].tolist() == [25.0, 25.0]
    assert table.loc["Tobon-Gomez et al. 2013", "points (mm)"] == "1.5 to 2.1"


def test_errors_are_those_of_the_curves_and_signs_cancel_in_the_bias_alone(
    acquisitions: Acquisitions,
) -> None:
    table = registration_table(acquisitions).set_index("acquisition")
    for name in ("q_max", "q_min"):
        assert table.loc["baseline", f"{name} (%)"] == pytest.approx(10.0)
        assert table.loc["baseline", f"{name} bias (%)"] == pytest.approx(0.0, abs=1e-9)
        assert table.loc["SNR 10", f"{name} bias (%)"] == pytest.approx(-30.0)  # a slope that is too small
    assert table.loc["SNR 10", "V_min bias (%)"] == pytest.approx(100.0 * 0.3 * 60.0 / 60.0)
    strains = ["circumferential (%)", "longitudinal (%)", "radial (%)"]
    assert table.loc["SNR 10", strains].tolist() == pytest.approx([2.0, 4.0, 6.0])
    points = ["points (mm)", "points 95th (mm)", "ES points (mm)", "ES points 95th (mm)"]
    assert table.loc["baseline", points].tolist() == pytest.approx([0.5, 1.5, 1.0, 2.0])
    assert table["folded"].tolist()[:3] == [3, 0, 0]


def test_each_segment_is_listed_with_its_true_strain() -> None:
    one = comparison(0.1, strain=0.03)
    one.registered_strain[6, 0, 4] += 0.04  # segment 5, at end systole
    table = segment_table([one, comparison(0.1, strain=0.01)]).set_index("segment")
    assert list(table.index) == list(range(1, 17))
    assert table["circumferential (%)"].to_numpy() == pytest.approx(np.full(16, -20.0))
    assert table.loc[1, "circumferential bias (%)"] == pytest.approx(2.0)
    assert table.loc[1, "circumferential RMS (%)"] == pytest.approx(np.sqrt((3.0**2 + 1.0) / 2.0))
    assert table.loc[5, "circumferential bias (%)"] == pytest.approx(4.0)
    assert table.loc[5, "longitudinal bias (%)"] == pytest.approx(-4.0)


def test_the_tables_are_written_without_holes(acquisitions: Acquisitions) -> None:
    table = registration_table(acquisitions)
    assert "NA" not in to_markdown(table)
    assert "nan" not in to_latex(table).lower()
    assert r"$q_{\max}$ bias (\%)" in to_latex(table)


def test_the_figure_shows_curves_strains_and_errors(acquisitions: Acquisitions, tmp_path: Path) -> None:
    figure = plot_registration(acquisitions, FEATURES, shown=2)
    volumes, _, strains, by_snr, by_frames = [axes for part in figure.subfigs for axes in part.axes]
    true, registered = volumes.get_lines()[:2]
    assert true.get_ydata().min() == pytest.approx(60.0)
    assert registered.get_ydata().min() == pytest.approx(66.0)
    assert len(volumes.get_lines()) == 4
    assert len(strains.containers) == 3
    slopes = {line.get_label(): line for line in by_snr.get_lines()}[r"$q_{\max}$"]
    assert slopes.get_xdata() == pytest.approx([10.0, 30.0, 50.0])
    assert slopes.get_ydata() == pytest.approx([30.0, 10.0, 5.0])
    assert by_frames.get_xlabel() == "frames"
    write_figure(tmp_path / "figure.png", figure)
    assert (tmp_path / "figure.png").stat().st_size > 20_000


def test_acquisitions_without_sequences_or_baseline_are_refused() -> None:
    with pytest.raises(InputError, match=r"SNR 10\b"):
        Acquisitions({"SNR": 30.0}, [comparison(0.1)], {"SNR": {10.0: []}})
    with pytest.raises(InputError, match=r"SNR.*baseline"):
        Acquisitions({}, [comparison(0.1)], {"SNR": {10.0: [comparison(0.1)]}})
