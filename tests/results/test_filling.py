"""Figure of filling: one row for each group of hearts, and the measured volume where there is one."""

import numpy as np

from heartfit.observation.curve import Curve
from heartfit.results.filling import plot_filling

TIMES = np.arange(40) * 0.02


def test_every_heart_is_drawn_and_the_measured_volume_once() -> None:
    volume = Curve(TIMES, 100e-6 + 50e-6 * np.cos(2 * np.pi * TIMES / 0.8), 0.8)
    flow = Curve(TIMES, 400e-6 * np.sin(np.pi * TIMES / 0.8), 0.8)
    hearts = {name: {"lv_volume": volume, "mitral_flow": flow} for name in ("standard", "extended")}
    figure = plot_filling({"sphere": hearts, "mesh": hearts}, {"mesh": volume})
    counts = [len(axes.get_lines()) for axes in figure.axes]
    assert counts == [3, 2, 4, 3], "hearts, the line of no flow, and the measured volume"
    (_, measured) = figure.axes[3].get_lines()[-2:]
    times, values = measured.get_xdata(), measured.get_ydata()
    assert np.min(times) >= 0.2
    assert np.allclose(values, 1e6 * volume(times))
    drawn = figure.axes[0].get_lines()[0]
    assert np.allclose(drawn.get_ydata(), 1e6 * flow(drawn.get_xdata()))
