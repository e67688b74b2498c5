"""The picture of what was read shows its phases, letters its sides, and says what is not there."""

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from tests.tables.imaged_beat import PERIOD, beating, images

from heartfit.geometry.mesh import VentricularMesh
from heartfit.observation.curve import Curve
from heartfit.observation.recorded_pressure import AveragedPressure
from heartfit.tables.patient_view import letters
from heartfit.tables.understood_figure import Understood, plot_understood


@pytest.mark.parametrize(
    ("direction", "expected"),
    [((1.0, 0.0, 0.0), "L"), ((-1.0, 0.0, 0.0), "R"), ((0.0, -0.8, 0.6), "AH"), ((0.1, 0.2, -1.0), "F")],
)
def test_letters_are_the_patients_sides(direction: tuple[float, ...], expected: str) -> None:
    assert letters(np.array(direction)) == expected


def texts(figure: Figure) -> list[str]:
    return [text.get_text() for axes in figure.axes for text in (axes.title, *axes.texts)]


def test_all_that_was_read_is_drawn(ventricle: VentricularMesh) -> None:
    times = np.arange(0.0, PERIOD, 0.004)
    curve = Curve(times, 8e3 + 7e3 * np.sin(8.0 * times), PERIOD)
    pressure = AveragedPressure(curve, np.tile(curve.values, (3, 1)), np.array([True, False, True]))
    heart = Understood("mine", "healthy", ventricle, beating(ventricle), images(ventricle), pressure)
    figure = plot_understood(heart)
    said = texts(figure)
    assert "end systole, 300 ms: slice" in said
    assert "left ventricular pressure,\nmean of 2 of 3 beats" in said
    drawn = figure.axes[3].collections
    assert all(isinstance(part, LineCollection) and part.get_segments() for part in drawn)


def test_what_is_not_there_is_said(ventricle: VentricularMesh) -> None:
    said = texts(plot_understood(Understood("mine", "lbbb", ventricle, None, None, None)))
    assert "no pressure given" in said
    assert "volumes follow\nfrom registration" in said
    assert any("left bundle branch block" in text for text in said)
