"""Figure of an imported case: it shows the phases, labels the sides, and names missing data."""

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from heartfit.geometry.mesh import VentricularMesh
from heartfit.observation.curve import Curve
from heartfit.observation.recorded_pressure import AveragedPressure
from heartfit.results.activation import ONSETS
from heartfit.results.contours import side_letters
from heartfit.results.understood import ImportedCase, plot_imported_case
from tests.printed import numbers_in
from tests.results.imaged_beat import PERIOD, beating, images


@pytest.mark.parametrize(
    ("direction", "expected"),
    [((1.0, 0.0, 0.0), "L"), ((-1.0, 0.0, 0.0), "R"), ((0.0, -0.8, 0.6), "AH"), ((0.1, 0.2, -1.0), "F")],
)
def test_letters_are_the_patients_sides(direction: tuple[float, ...], expected: str) -> None:
    assert side_letters(np.array(direction)) == expected


def texts(figure: Figure) -> list[str]:
    return [text.get_text() for axes in figure.axes for text in (axes.title, *axes.texts)]


def test_all_imported_data_are_drawn(ventricle: VentricularMesh) -> None:
    times = np.arange(0.0, PERIOD, 0.004)
    curve = Curve(times, 8e3 + 7e3 * np.sin(8.0 * times), PERIOD)
    pressure = AveragedPressure(curve, np.tile(curve.values, (3, 1)), np.array([True, False, True]))
    heart = ImportedCase("mine", "healthy", ventricle, beating(ventricle), images(ventricle), pressure)
    figure = plot_imported_case(heart)
    labels = texts(figure)
    assert [text for text in labels if 300.0 in numbers_in(text)], "end systole is at 300 ms"
    assert [text for text in labels if numbers_in(text) == [2.0, 3.0]], "two of three beats are kept"
    drawn = figure.axes[3].collections
    assert all(isinstance(part, LineCollection) and part.get_segments() for part in drawn)


def test_missing_data_are_named(ventricle: VentricularMesh) -> None:
    figure = plot_imported_case(ImportedCase("mine", "lbbb", ventricle, None, None, None))
    absent = [axes for axes in figure.axes if axes.texts and not axes.lines and not axes.collections]
    assert len(absent) == 3, "volume, pressure and their loop"
    assert any(ONSETS["lbbb"] in text for text in texts(figure))
