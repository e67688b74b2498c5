"""Residuals of healthy hearts from which the structural discrepancy is learnt: those of simulators, or of controls.

healthy_residuals.csv: simulator,seed,volume_0,...,volume_99,pressure_0,...,pressure_99, over the end-diastolic volume
and the range of the pressure.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.landmarks import PHASES
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.io.files import write_text
from heartfit.io.recordings import read_recording
from heartfit.io.text import number_in, read_cells

HEALTHY_RESIDUALS = Path(__file__).with_name("healthy_residuals.csv")
"""Residuals of healthy hearts of simulators that others wrote."""
COLUMNS = tuple(f"{curve}_{phase}" for curve in ("volume", "pressure") for phase in range(PHASES))
FEWEST_CONTROLS = 5
"""Least number of controls: fewer tell neither the size nor the shape of what healthy hearts leave."""


def write_residuals(path: Path, residuals: Mapping[tuple[str, int], Floats]) -> None:
    """Write residuals (2 PHASES,) by simulator and seed."""
    rows = [
        ",".join([simulator, str(seed), *(f"{value:.4f}" for value in residual)])
        for (simulator, seed), residual in residuals.items()
    ]
    write_text(path, "\n".join([",".join(["simulator", "seed", *COLUMNS]), *rows]) + "\n")


def read_residuals(path: Path = HEALTHY_RESIDUALS, leave_out: Iterable[str] = ()) -> Floats:
    """Read residuals (N, 2 PHASES) of all simulators but those left out."""
    cells = read_cells(path, ",", "residuals of healthy hearts as CSV")
    kept = [row for row, simulator in enumerate(cells["simulator"]) if simulator not in set(leave_out)]
    table = [[number_in(path, column, row, cells[column][row]) for column in COLUMNS] for row in kept]
    return np.array(table)


def read_controls(folder: Path) -> dict[str, Recording]:
    """Read the recordings of a reference group, a CSV each, by file name.

    Raises InputError for a folder with fewer than FEWEST_CONTROLS.
    """
    paths = sorted(Path(folder).glob("*.csv"))
    if len(paths) < FEWEST_CONTROLS:
        raise InputError(
            f"{folder}: {len(paths)} recordings; expected a folder with at least {FEWEST_CONTROLS} CSV files, one for "
            "each control"
        )
    return {path.name: read_recording(path) for path in paths}
