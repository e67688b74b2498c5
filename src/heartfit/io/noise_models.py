"""Noise models, comparisons of motions, plausible ranges and Sobol indices as JSON."""

from math import inf
from pathlib import Path

from heartfit.calibration.plausible import Limit, Plausible
from heartfit.calibration.sobol import SobolIndices
from heartfit.io.results import read_record, write_result
from heartfit.io.tables import read_published
from heartfit.observation.comparison import Comparison
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.scatter import Scatter
from heartfit.study.study import Study

NOISE_UNITS = {
    "observations": "V_min, P_max: (measured - true) / measured range; rates: ln(measured / true)",
    "curve": "(measured - true) / measured stroke volume",
}


def write_noise_model(path: Path, model: NoiseModel, fingerprint: str) -> None:
    """Write the noise of the observations and of the curve."""
    write_result(path, {"noise_model": model}, fingerprint, NOISE_UNITS)


def read_noise_model(path: Path) -> NoiseModel:
    """Read a noise model; raises InputError for a missing or broken file."""
    return read_record(path, NoiseModel, "noise_model")


def stored_noise_model(study: Study) -> str | None:
    """File of the stored noise model of a study; None if the study learns its own.

    It does to compare methods, and where the protocol of its images is another one.
    """
    path = study.registration_error.noise_model
    if path is None or study.methods or read_noise_model(Path(path)).protocol != study.protocol():
        return None
    return path


def write_sensors(path: Path, sensors: Scatter, fingerprint: str) -> None:
    """Write the scatter of the image sensors' parameters."""
    write_result(path, {"sensors": sensors}, fingerprint, {"sensors": "SI"})


def read_sensors(path: Path) -> Scatter:
    """Read the scatter of the image sensors; raises InputError for a missing or broken file."""
    return read_record(path, Scatter, "sensors")


COMPARISON_UNITS = {"curves": "m^3, Pa over s", "observations": "SI", "strain": "1", "point_error": "m"}


def write_comparison(path: Path, comparison: Comparison, fingerprint: str) -> None:
    """Write a comparison of two motions."""
    write_result(path, {"comparison": comparison}, fingerprint, COMPARISON_UNITS)


def read_comparison(path: Path) -> Comparison:
    """Read a comparison; raises InputError for a missing or broken file."""
    return read_record(path, Comparison, "comparison")


def read_limits(path: Path) -> list[Limit]:
    """Read limits from a table with quantity, low, high and unit_si; an empty cell is no limit."""
    table = read_published(path).fillna({"low": -inf, "high": inf})
    return [Limit(row.quantity, row.low * row.unit_si, row.high * row.unit_si) for row in table.itertuples()]


def write_ranges(path: Path, ranges: Plausible, fingerprint: str) -> None:
    """Write plausible ranges of parameters."""
    write_result(path, ranges, fingerprint, {"standard": "SI"})


def read_ranges(path: Path) -> Plausible:
    """Read plausible ranges; raises InputError for a missing or broken file."""
    return read_record(path, Plausible)


def write_sobol(path: Path, indices: SobolIndices, fingerprint: str) -> None:
    """Write Sobol indices."""
    write_result(path, {"indices": indices}, fingerprint)


def read_sobol(path: Path) -> SobolIndices:
    """Read Sobol indices; raises InputError for a missing or broken file."""
    return read_record(path, SobolIndices, "indices")
