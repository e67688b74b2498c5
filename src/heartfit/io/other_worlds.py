"""Bank of beats of other simulators, resources/other_worlds: a file for each simulator, a row for each beat.

seed,illness,severity,period_s,volume_ml_0,...,volume_ml_199,pressure_mmhg_0,...,pressure_mmhg_199
"""

from pathlib import Path

import numpy as np

from heartfit.io.text import PASCAL, number_in, read_cells
from heartfit.observation.curve import Curve
from heartfit.synthetic.other_worlds import OtherHeart

VOLUME, PRESSURE = ("volume_ml_", 1e-6), ("pressure_mmhg_", PASCAL["mmhg"])
"""Beginning of the names of the columns, and SI value of their unit."""


def read_other_hearts(path: Path) -> list[OtherHeart]:
    """Read the beats of a simulator, whose name is that of the file."""
    cells = read_cells(path, ",", "beats of a simulator as CSV")
    text = ("seed", "illness", "severity")
    numbers = {
        column: [number_in(path, column, row, cell) for row, cell in enumerate(column_cells)]
        for column, column_cells in cells.items()
        if column not in text
    }
    return [
        OtherHeart(
            Path(path).stem,
            int(cells["seed"][row]),
            cells["illness"][row],
            cells["severity"][row],
            *(_curve(numbers, beginning, unit, row, period) for beginning, unit in (VOLUME, PRESSURE)),
        )
        for row, period in enumerate(numbers["period_s"])
    ]


def _curve(numbers: dict[str, list[float]], beginning: str, unit: float, row: int, period: float) -> Curve:
    """Return the curve of a row over equidistant phases."""
    values = np.array([column[row] for name, column in numbers.items() if name.startswith(beginning)])
    return Curve(np.arange(values.size) * period / values.size, unit * values, period)
