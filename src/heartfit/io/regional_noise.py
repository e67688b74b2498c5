"""Noise of the strain of a registered wall: that of the study's scanner and registration, or one of a user's own.

kind,gain,common_sd,element_sd,sd,memory,shared,sequences: one row for each kind of regional curve, see
:mod:`heartfit.observation.gain_noise`; standard deviations of strain [1] and of the descent of the
base [m], memory [s].
"""

from pathlib import Path

from heartfit.core.errors import InputError
from heartfit.io.text import number_in, read_cells
from heartfit.observation.gain_noise import GainNoise
from heartfit.observation.regional import KINDS
from heartfit.observation.regional_noise import RegionalNoise

LEARNED = Path(__file__).with_name("regional_noise.csv")
"""Noise of the study's scanner and registration, from `python -m benchmarks.strain_noise`."""
NUMBERS = ("gain", "common_sd", "element_sd", "sd", "memory", "shared", "sequences")


def read_regional_noise(path: Path = LEARNED) -> RegionalNoise:
    """Read the noise of all regional curves; raises InputError that names the file for another content."""
    columns = read_cells(path, ",", "the noise of regional curves")
    missing = [name for name in ("kind", *NUMBERS) if name not in columns]
    absent = [kind for kind in KINDS if kind not in columns.get("kind", [])]
    if missing or absent:
        raise InputError(
            f"{path}: no column or row {', '.join([*missing, *absent])}; expected kind, {', '.join(NUMBERS)} "
            f"for each of {', '.join(KINDS)}"
        )
    return RegionalNoise({kind: _noise(path, columns, columns["kind"].index(kind)) for kind in KINDS})


def _noise(path: Path, columns: dict[str, list[str]], row: int) -> GainNoise:
    gain, common, element, sd, memory, shared, sequences = (
        number_in(path, name, row, columns[name][row]) for name in NUMBERS
    )
    if not (gain > 0.0 and sd > 0.0 and memory > 0.0 and min(common, element) >= 0.0 and 0.0 <= shared < 1.0):
        raise InputError(
            f"{path}: {columns['kind'][row]}: expected a positive gain, sd and memory, other standard deviations of at "
            "least 0, and a shared part below 1"
        )
    return GainNoise(gain, common, element, sd, memory, shared, int(sequences))
