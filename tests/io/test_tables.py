"""The suffix says the format of a table; published tables are read without their origin lines."""

from pathlib import Path

import pandas as pd
import pytest
from matplotlib.figure import Figure

from heartfit.io.tables import read_published, write_figure, write_table

TABLE = pd.DataFrame({"setting": ["paper"], "case": ["a_b"], "sigma_0 (kPa)": [240.0]})


@pytest.mark.parametrize(
    ("suffix", "content"), [("csv", "paper,a_b,240"), ("md", "| paper "), ("tex", r"$\sigma_{0}$ (kPa) \\")]
)
def test_the_suffix_decides(tmp_path: Path, suffix: str, content: str) -> None:
    write_table(tmp_path / f"table.{suffix}", TABLE)
    assert content in (tmp_path / f"table.{suffix}").read_text()


def test_another_suffix_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"\.xlsx"):
        write_table(tmp_path / "table.xlsx", TABLE)


def test_the_published_means_recompute_to_their_rounding() -> None:
    folder = Path(__file__).parents[2] / "resources" / "marchesseau2012"
    for name, tolerance in (("table1.csv", 0.01), ("table2.csv", 0.06)):
        table = read_published(folder / name)
        volunteers = table[[str(number) for number in range(1, 8)]]
        assert volunteers.mean(axis=1).tolist() == pytest.approx(table["mean"].tolist(), abs=tolerance)


@pytest.mark.parametrize("suffix", ["png", "pdf"])
def test_a_figure_is_the_same_file_every_time(tmp_path: Path, suffix: str) -> None:
    for name in ("a", "b"):
        figure = Figure()
        figure.subplots().plot([0, 1])
        write_figure(tmp_path / f"{name}.{suffix}", figure)
    content = (tmp_path / f"a.{suffix}").read_bytes()
    assert content == (tmp_path / f"b.{suffix}").read_bytes()
    assert b"CreationDate" not in content
    assert b"Software" not in content
