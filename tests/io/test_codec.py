"""Every stored kind is read and written again to the same bytes; an invalid record is refused in one line."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, Literal, get_args, get_origin, get_type_hints

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.plausible import Plausible
from heartfit.calibration.sensitivity import Sensitivity
from heartfit.calibration.sobol import SobolIndices
from heartfit.calibration.unscented import SigmaPoint
from heartfit.calibration.update import Posterior
from heartfit.core.errors import InputError
from heartfit.discovery.refit.refit import Refit
from heartfit.discovery.sphere_model.cause import Attempt
from heartfit.io.causes import TraceFile
from heartfit.io.results import decode, encode, read_record, read_result, write_result
from heartfit.observation.comparison import Comparison
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import Measurement
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.scatter import Scatter
from heartfit.results.case import CaseResult
from heartfit.synthetic.case import Answer
from heartfit.synthetic.trial import ScoredDiagnosis

KINDS = (
    *(Answer, Attempt, CaseResult, Comparison, ScoredDiagnosis, Gaussian, Measurement, NoiseModel, Plausible),
    *(Posterior, Refit, Scatter, Sensitivity, SigmaPoint, SobolIndices, TraceFile),
)
DEEPEST = 6


def example(kind: Any, rng: np.random.Generator, depth: int = 0) -> Any:
    """A random value of an annotated type; numbers are of every size, and now and then not finite or an integer."""
    plain = {
        bool: lambda: bool(rng.integers(2)),
        int: lambda: int(rng.integers(20, 10**12)),
        float: lambda: rng.choice([rng.normal() * 10.0 ** rng.integers(-9, 9), 1e-300, np.nan, np.inf, -0.0]),
        str: lambda: rng.choice(["", "m^3", "über", 'a "quoted" name']).item(),
        type(None): lambda: None,
        Gaussian: lambda: Gaussian(("K", "mu"), rng.normal(size=2), np.diag(rng.random(2))),
        Curve: lambda: Curve(np.sort(rng.random(9)), rng.normal(size=9), 1.5),
    }
    if kind in plain:
        return plain[kind]()
    if is_dataclass(kind):
        hints = get_type_hints(kind)
        return kind(**{entry.name: example(hints[entry.name], rng, depth + 1) for entry in fields(kind)})
    return composed(kind, rng, depth + 1)


def composed(kind: Any, rng: np.random.Generator, depth: int) -> Any:
    """An array, a choice, a mapping or a sequence, empty where the nesting would not end."""
    origin, inner = get_origin(kind), get_args(kind)
    count = int(rng.integers(0 if depth < DEEPEST else -5, 3))
    if np.ndarray in (kind, origin):
        whole = "int64" in str(kind)
        return rng.integers(-9, 9, 4) if whole else rng.normal(size=rng.integers(1, 4, rng.integers(1, 4)))
    if origin is Literal:
        return inner[rng.integers(len(inner))]
    if origin in (Mapping, dict):
        return {f"name {n}": example(inner[1], rng, depth) for n in range(count)}
    if origin is tuple and inner[-1] is not ...:
        return tuple(example(part, rng, depth) for part in inner)
    if origin in (tuple, Sequence):
        return tuple(example(inner[0], rng, depth) for _ in range(count))
    value = example(inner[rng.integers(len(inner))], rng, depth)
    return 0.5 if isinstance(value, float) and not np.isfinite(value) else value


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_a_record_is_read_and_written_again_to_the_same_bytes(tmp_path, kind):
    rng = np.random.default_rng(17)
    for _ in range(12):
        write_result(tmp_path / "once.json", example(kind, rng), "0123")
        write_result(tmp_path / "twice.json", read_record(tmp_path / "once.json", kind), "0123")
        assert (tmp_path / "once.json").read_bytes() == (tmp_path / "twice.json").read_bytes()


def test_nan_is_written_as_null_and_read_as_nan(tmp_path):
    record = Scatter(("K", "mu"), 20, np.array([np.nan, 1.0]), np.diag([np.inf, 2.0]))
    write_result(tmp_path / "g.json", record, "0123")
    assert read_result(tmp_path / "g.json") == {
        "names": ["K", "mu"],
        "count": 20,
        "mean": [None, 1.0],
        "covariance": [[None, 0.0], [0.0, 2.0]],
    }
    assert np.array_equal(read_record(tmp_path / "g.json", Scatter).mean, [np.nan, 1.0], equal_nan=True)


def test_numbers_of_numpy_are_plain_numbers():
    numbers = {"a": np.float32(0.5), "b": np.int64(3), "c": [np.bool_(True)], "d": np.float64(2.0)}
    assert json.dumps(encode(numbers)) == '{"a": 0.5, "b": 3, "c": [true], "d": 2.0}'


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({"index": 0, "label": "", "z": []}, "parameters"),
        ({"index": 0, "label": "", "z": [], "parameters": {}, "more": 1}, "more"),
        ({"index": 0.5, "label": "", "z": [], "parameters": {}}, "index"),
        ({"index": 0, "label": None, "z": [], "parameters": {}}, "label"),
        ({"index": 0, "label": "", "z": [], "parameters": {"mu": "much"}}, "mu"),
        ([], "SigmaPoint"),
        (None, "SigmaPoint"),
    ],
)
def test_an_invalid_record_is_refused_in_one_line(content, message):
    with pytest.raises(
        InputError, match=rf"points\.json: .*{message}.*; delete it and run the stage again"
    ) as error:
        decode(content, SigmaPoint, "points.json")
    assert "\n" not in str(error.value)
