"""Stored records: the typed codec between dataclasses and JSON, and the results of a study.

pydantic encodes a value by its type, cattrs decodes by the declared types of the fields. Numbers keep their digits and
their kind, so a file that is read and written again stays the same to the byte. JSON has neither NaN nor infinity: they
become null, and null instead of a number becomes NaN.
"""

import json
from collections.abc import Mapping, Sequence
from math import nan
from pathlib import Path
from types import GenericAlias
from typing import Any, TypeVar, get_args, get_origin

import numpy as np
from cattrs import Converter, transform_error
from cattrs.strategies import configure_union_passthrough
from cattrs.v import format_exception
from pydantic_core import to_jsonable_python

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.sensitivity import Sensitivity
from heartfit.calibration.unscented import SigmaPoint
from heartfit.calibration.update import Posterior, long_steps
from heartfit.core.errors import InputError
from heartfit.io.files import require_as_written, write_text
from heartfit.io.fingerprint import versions
from heartfit.observation.measurement import Measurement
from heartfit.results.case import CaseResult

T = TypeVar("T")
CONVERTER = Converter(forbid_extra_keys=True)


def encode(value: Any) -> Any:
    """Encode a record, an array, or a mapping or sequence of them for JSON."""
    return to_jsonable_python(value, inf_nan_mode="null", fallback=_plain)


def decode(content: Any, kind: type[T], where: str) -> T:
    """Decode a record of a kind; raises InputError for other content, ``where`` names its place."""
    try:
        return CONVERTER.structure(content, kind)
    except Exception as fault:  # an exception group with the errors of all fields
        first = transform_error(fault, path=kind.__name__, format_exception=_reason)[0]
        raise InputError(f"{where}: {first}; delete it and run the stage again") from None


def _reason(fault: BaseException, kind: type | None) -> str:
    return str(fault) if isinstance(fault, ValueError | TypeError) else format_exception(fault, kind)


def _plain(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else dict(value)


def _array(content: Any, _: Any) -> np.ndarray:
    array = np.array(content)
    return array.astype(float) if array.dtype == object else array


def _scalar(content: Any, kind: type) -> Any:
    """Return a scalar unchanged, an integer for a float too; raises TypeError for another kind."""
    if kind is float and content is None:
        return nan
    if not isinstance(content, int | float if kind is float else kind):
        raise TypeError(f"expected {kind.__name__}, not {content!r}")
    return content


def _is_sequence(kind: Any) -> bool:
    return get_origin(kind) is Sequence


def _list(content: Any, kind: Any) -> Any:
    kind_of_list: Any = GenericAlias(list, get_args(kind))
    return CONVERTER.structure(content, kind_of_list)


for _kind in (bool, int, float, str):
    CONVERTER.register_structure_hook(_kind, _scalar)
CONVERTER.register_structure_hook_func(lambda kind: np.ndarray in (kind, get_origin(kind)), _array)
CONVERTER.register_structure_hook_func(_is_sequence, _list)
configure_union_passthrough(bool | int | float | str, CONVERTER)


def write_result(path: Path, content: Any, fingerprint: str, units: Mapping[str, str] | None = None) -> None:
    """Write {"fingerprint", "made_by", "units", "content"}; NaN and infinity become null."""
    provenance = {"fingerprint": fingerprint, "made_by": versions()}
    result = provenance | {"units": dict(units or {}), "content": encode(content)}
    write_text(path, json.dumps(result, indent=1, allow_nan=False) + "\n")


def read_result(path: Path) -> dict[str, Any]:
    """Read the content of a result; raises InputError for a missing or broken file."""
    return _read(path)["content"]


def read_record(path: Path, kind: type[T], key: str = "") -> T:
    """Read the content, or its entry under a key, as a record; raises InputError for a missing or broken file."""
    content = read_result(path)
    return decode(content.get(key) if key else content, kind, str(path))


def read_fingerprint(path: Path) -> str:
    """Read the fingerprint of the code that wrote a result."""
    return _read(path)["fingerprint"]


def write_sigma_points(path: Path, around: Gaussian, points: list[SigmaPoint], fingerprint: str) -> None:
    """Write the Gaussian that the sigma points represent, the prior in a first iteration, and the points."""
    write_result(
        path, {"around": around, "points": points}, fingerprint, {"parameters": "SI", "z": "ln of SI"}
    )


def read_sigma_points(path: Path) -> tuple[Gaussian, list[SigmaPoint]]:
    """Read the Gaussian of the sigma points, and the points."""
    return read_record(path, Gaussian, "around"), read_record(path, list[SigmaPoint], "points")


def write_observations(path: Path, measurement: Measurement, fingerprint: str) -> None:
    """Write the observations of a case."""
    units = {observation.name: observation.unit for observation in measurement.observations}
    write_result(path, measurement, fingerprint, units)


def read_observations(path: Path) -> Measurement:
    """Read the observations of a case."""
    return read_record(path, Measurement)


def write_posterior(path: Path, posterior: Posterior, fingerprint: str) -> None:
    """Write a posterior, with its physical estimate, relative deviations and steps under "summary"."""
    summary = {
        "estimate": posterior.estimate.physical(),
        "relative_sd": dict(zip(posterior.estimate.names, posterior.estimate.sd, strict=True)),
        "step": dict(zip(posterior.prior.names, posterior.step, strict=True)),
        "long_steps": list(long_steps(posterior.prior.names, posterior.step)),
    }
    write_result(
        path,
        {"summary": summary, "posterior": posterior},
        fingerprint,
        {"summary.estimate": "SI", "summary.step": "prior standard deviations", "posterior": "ln of SI"},
    )


def read_posterior(path: Path) -> Posterior:
    """Read a posterior."""
    return read_record(path, Posterior, "posterior")


def write_sensitivity(path: Path, result: Sensitivity, fingerprint: str) -> None:
    """Write the sensitivities of the observations to the parameters."""
    units = {"centre": "SI", "covariance": "1", "slopes": "d ln Z / d ln theta"}
    write_result(path, result, fingerprint, units)


def read_sensitivity(path: Path) -> Sensitivity:
    """Read the sensitivities; see heartfit.calibration.sensitivity."""
    return read_record(path, Sensitivity)


def read_truth(path: Path) -> dict[str, float]:
    """Read the true parameters (SI) of a virtual volunteer; only the evaluation of the tables uses them."""
    return read_result(path)["parameters"]


def write_case(path: Path, case: CaseResult) -> None:
    """Write the errors of a calibrated case."""
    write_result(path, case, case.fingerprint, {"observed": "SI", "estimate": "SI"})


def read_case(path: Path) -> CaseResult:
    """Read the errors of a calibrated case."""
    return read_record(path, CaseResult)


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
