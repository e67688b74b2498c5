"""Calibrated cases in, InferenceData out."""

from collections.abc import Iterable
from pathlib import Path

import xarray as xr

from heartfit.exchange.calibrated import Calibrated
from heartfit.exchange.inference_data import groups
from heartfit.io.atomic import replacing
from heartfit.io.beats import read_beat
from heartfit.io.curves import read_curves
from heartfit.io.made_by import made_by
from heartfit.io.results import read_case, read_observations, read_posterior
from heartfit.observation.beat import beat_curves


def read_calibrated(results: Path, case: str, setting: str) -> Calibrated:
    """What a study says of a case under a setting; raises InputError for a missing or broken file."""
    whole, below = Path(results, case), Path(results, case, setting)
    met = read_posterior(below / "calibration" / "posterior.json")
    return Calibrated(
        read_case(below / "verification" / "errors.json"),
        met,
        read_posterior(below / "calibration" / "posterior_noise.json"),
        read_observations(whole / "curves" / "observations.json"),
        read_curves(whole / "curves" / "measured.csv"),
        beat_curves(read_beat(below / "verification" / "beat.json")),
    )


def write_inference_data(path: Path, found: Calibrated) -> None:
    """Write a NetCDF that arviz.from_netcdf reads; the same case gives the same bytes."""
    about = {
        "case": found.case.case,
        "setting": found.case.setting,
        "inference_library": "heartfit",
        "fingerprint": found.case.fingerprint,
        "history": f"made by {made_by()}",
        "Conventions": "CF-1.11",
    }
    tree = {name: group.assign_attrs(about | group.attrs) for name, group in groups(found).items()}
    with replacing(path) as draft:
        xr.DataTree.from_dict({"/": xr.Dataset(attrs=about), **tree}).to_netcdf(draft, engine="h5netcdf")


def write_every_inference_data(results: Path, found: Iterable[Calibrated]) -> None:
    """Write inference.nc into the folder of every case and setting."""
    for each in found:
        write_inference_data(Path(results, each.case.case, each.case.setting, "inference.nc"), each)
