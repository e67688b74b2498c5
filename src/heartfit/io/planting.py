"""Write planted cases: their recordings, and their answers under seal."""

from pathlib import Path

from heartfit.io.curves import write_curves
from heartfit.io.recordings import MEASURED
from heartfit.io.seals import seal
from heartfit.synthetic.case import REST, PlantedCase


def write_planted(case: PlantedCase, measured: Path, sealed: Path) -> None:
    """Write the recordings into the folder ``measured``/SEED, and seal the answer as ``sealed``/SEED.answer."""
    seed = str(case.answer.seed)
    for condition, curves in case.curves.items():
        write_curves(Path(measured, seed, MEASURED if condition == REST else f"{condition}.csv"), curves)
    seal(Path(sealed, f"{seed}.answer"), case.answer)
