"""Results as JSON: SI numbers beside their units, and the fingerprint of the code that made them."""

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import SigmaPoint
from heartfit.calibration.update import Posterior
from heartfit.errors import InputError
from heartfit.io.atomic import write_text
from heartfit.io.made_by import versions
from heartfit.io.sums import require_as_written
from heartfit.observation.measurement import Measurement
from heartfit.observation.noise import Observation
from heartfit.sensitivity.covariance import Sensitivity
from heartfit.tables.case import CaseResult


def write_result(
    path: Path, content: Mapping[str, Any], fingerprint: str, units: Mapping[str, str] | None = None
) -> None:
    """Write {"fingerprint", "made_by", "units", "content"}; NaN and infinity become null."""
    made = {"fingerprint": fingerprint, "made_by": versions()}
    result = made | {"units": dict(units or {}), "content": _plain(content)}
    write_text(path, json.dumps(result, indent=1, allow_nan=False) + "\n")


def read_result(path: Path) -> dict[str, Any]:
    """The content; raises InputError for a missing or broken file."""
    return _read(path)["content"]


def read_fingerprint(path: Path) -> str:
    """The fingerprint of the code that wrote the file."""
    return _read(path)["fingerprint"]


def write_sigma_points(path: Path, prior: Gaussian, points: list[SigmaPoint], fingerprint: str) -> None:
    write_result(path, {"prior": prior, "points": points}, fingerprint, {"parameters": "SI", "z": "ln of SI"})


def read_sigma_points(path: Path) -> tuple[Gaussian, list[SigmaPoint]]:
    content = read_result(path)
    points = [SigmaPoint(**{**point, "z": np.array(point["z"])}) for point in content["points"]]
    return _gaussian(content["prior"]), points


def write_observations(path: Path, measurement: Measurement, fingerprint: str) -> None:
    units = {observation.name: observation.unit for observation in measurement.observations}
    write_result(path, _shallow(measurement), fingerprint, units)


def read_observations(path: Path) -> Measurement:
    content = read_result(path)
    observations = [Observation(**observation) for observation in content["observations"]]
    return Measurement(observations, np.array(content["covariance"]))


def write_posterior(path: Path, posterior: Posterior, fingerprint: str) -> None:
    summary = {
        "estimate": posterior.estimate.physical(),
        "relative_sd": dict(zip(posterior.estimate.names, posterior.estimate.sd, strict=True)),
    }
    write_result(
        path,
        {"summary": summary, "posterior": posterior},
        fingerprint,
        {"summary.estimate": "SI", "posterior": "ln of SI"},
    )


def read_posterior(path: Path) -> Posterior:
    content = read_result(path)["posterior"]
    arrays = ("observed", "predicted", "gain", "cov_xz", "cov_zz", "step", "sensitivity", "singular_values")
    return Posterior(
        prior=_gaussian(content["prior"]),
        estimate=_gaussian(content["estimate"]),
        observations=tuple(content["observations"]),
        failed=tuple(content["failed"]),
        notes=tuple(content["notes"]),
        **{name: np.array(content[name]) for name in arrays},
    )


def write_sensitivity(path: Path, result: Sensitivity, fingerprint: str) -> None:
    units = {"centre": "SI", "covariance": "1", "slopes": "d ln Z / d ln theta"}
    write_result(path, _shallow(result), fingerprint, units)


def read_sensitivity(path: Path) -> Sensitivity:
    """What every parameter does to every observation; see heartfit.sensitivity.covariance."""
    content = read_result(path)
    centre, covariance, slopes = (np.array(content[name]) for name in ("centre", "covariance", "slopes"))
    names, failed = tuple(content["observations"]), tuple(content["failed"])
    return Sensitivity(_gaussian(content["prior"]), names, centre, covariance, slopes, failed)


def read_truth(path: Path) -> dict[str, float]:
    """The parameters (SI) a virtual volunteer was made with; only the evaluation of the tables reads them."""
    return read_result(path)["parameters"]


def write_case(path: Path, case: CaseResult) -> None:
    write_result(path, _shallow(case), case.fingerprint, {"observed": "SI", "estimate": "SI"})


def read_case(path: Path) -> CaseResult:
    content = read_result(path)
    shift = float("nan") if content["shift"] is None else content["shift"]
    return CaseResult(**{**content, "shift": shift})


def _read(path: Path) -> dict[str, Any]:
    if not Path(path).is_file():
        raise InputError(f"{path}: no such result; expected a file the study writes: run the stage before")
    require_as_written(path)
    try:
        result = json.loads(Path(path).read_text(encoding="utf-8"))
    except json.JSONDecodeError as error:
        raise InputError(f"{path}: not JSON ({error}); delete it and run the stage again") from error
    if not isinstance(result, dict) or not {"fingerprint", "units", "content"} <= set(result):
        raise InputError(
            f"{path}: expected fingerprint, units and content; delete it and run the stage again"
        )
    return result


def _gaussian(content: Mapping[str, Any]) -> Gaussian:
    return Gaussian(tuple(content["names"]), np.array(content["mean"]), np.array(content["covariance"]))


def _shallow(record: Any) -> dict[str, Any]:
    return {field.name: getattr(record, field.name) for field in fields(record)}


def _plain(value: Any) -> Any:
    """Arrays as lists, dataclasses as dictionaries."""
    if is_dataclass(value) and not isinstance(value, type):
        return _plain(_shallow(value))
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [_plain(item) for item in value]
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value
