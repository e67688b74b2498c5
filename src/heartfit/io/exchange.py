"""Calibrated cases of a study, and their export as InferenceData and as a table of models."""

from collections.abc import Iterable, Mapping
from pathlib import Path

import xarray as xr
import yaml

from heartfit.io.beats import read_beat
from heartfit.io.curves import read_curves
from heartfit.io.files import replacing, write_text
from heartfit.io.fingerprint import made_by
from heartfit.io.results import read_case, read_observations, read_posterior
from heartfit.observation.beat import beat_curves
from heartfit.results.case import CaseResult
from heartfit.results.exchange import Calibrated
from heartfit.results.model_space import ModelSpace


def read_calibrated(results: Path, case: str, setting: str) -> Calibrated:
    """Read the results of a case under a setting; raises InputError for a missing or broken file."""
    whole, below = Path(results, case), Path(results, case, setting)
    noise_free = read_posterior(below / "calibration" / "posterior.json")
    return Calibrated(
        read_case(below / "verification" / "errors.json"),
        noise_free,
        read_posterior(below / "calibration" / "posterior_noise.json"),
        read_observations(whole / "curves" / "observations.json").of(noise_free.observations),
        read_curves(whole / "curves" / "measured.csv"),
        beat_curves(read_beat(below / "verification" / "beat.json")),
    )


def write_inference_data(path: Path, case: CaseResult, groups: Mapping[str, xr.Dataset]) -> None:
    """Write a NetCDF that arviz.from_netcdf reads; the same groups give the same bytes."""
    attributes = {
        "case": case.case,
        "setting": case.setting,
        "inference_library": "heartfit",
        "fingerprint": case.fingerprint,
        "history": f"made by {made_by()}",
        "Conventions": "CF-1.11",
    }
    tree = {name: group.assign_attrs(attributes | group.attrs) for name, group in groups.items()}
    with replacing(path) as draft:
        xr.DataTree.from_dict({"/": xr.Dataset(attrs=attributes), **tree}).to_netcdf(draft, engine="h5netcdf")


def write_every_inference_data(
    results: Path, cases: Iterable[Calibrated], groups: Iterable[Mapping[str, xr.Dataset]]
) -> None:
    """Write the groups of every case and setting as inference.nc into its folder."""
    for calibrated, datasets in zip(cases, groups, strict=True):
        case = calibrated.case
        write_inference_data(Path(results, case.case, case.setting, "inference.nc"), case, datasets)


def write_model_space(folder: Path, space: ModelSpace) -> None:
    """Write the tables as YAML and the rows as tab-separated values."""
    for name, content in space.tables.items():
        write_text(Path(folder, name), yaml.safe_dump(content, sort_keys=False))
    for name, rows in space.rows.items():
        write_text(Path(folder, name), "".join("\t".join(row) + "\n" for row in rows))
