"""The noise of strain as a file: that of the study is the printed one, others are read or refused."""

from pathlib import Path

import pandas as pd
import pytest

from heartfit.core.errors import InputError
from heartfit.io.regional_noise import LEARNED, read_regional_noise

MEASURED = Path(__file__).parents[2] / "docs" / "measured" / "strain_noise.tsv"
ROWS = {
    "circumferential": "circumferential strain",
    "longitudinal": "longitudinal strain",
    "base_descent": "base descent",
}
COLUMNS = {
    "gain": "G",
    "common_sd": "sd_g",
    "element_sd": "sd_h",
    "sd": "s",
    "memory": "tau (s)",
    "shared": "r",
}


def test_the_noise_of_the_study_is_that_of_its_page() -> None:
    printed = pd.read_csv(MEASURED, sep="\t", comment="#", index_col="curve").fillna(0.0)
    noise = read_regional_noise()
    for kind, row in ROWS.items():
        for name, column in COLUMNS.items():
            assert getattr(noise.kinds[kind], name) == pytest.approx(printed.loc[row, column])
        assert noise.kinds[kind].sequences == printed.loc[row, "sequences"]


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("circumferential", "radial", "no column or row circumferential"),
        ("memory", "memories", "no column or row memory"),
        ("0.913", "-0.913", "circumferential: expected a positive gain"),
        ("0.00848", "much", "sd"),
    ],
)
def test_another_content_is_refused(tmp_path: Path, old: str, new: str, expected: str) -> None:
    path = tmp_path / "noise.csv"
    path.write_text(LEARNED.read_text().replace(old, new))
    with pytest.raises(InputError, match=expected) as refusal:
        read_regional_noise(path)
    assert str(path) in str(refusal.value)
