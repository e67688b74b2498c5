"""Refits of extended models as JSON, and what a refit is given."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from heartfit.io.causes import read_cause
from heartfit.io.curves import read_curves
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.noise_models import read_noise_model
from heartfit.io.results import read_result, read_truth, write_result
from heartfit.proof.model import Model
from heartfit.proof.prove import Trial
from heartfit.proof.refit import Refit
from heartfit.proof.target import MeasuredCase
from heartfit.tables.discovery_table import Proved


def read_measured_case(curves: Path, models: Sequence[Path]) -> MeasuredCase:
    """Measured curves without the bias of the noise models, of which there is one or none."""
    return MeasuredCase.of(read_curves(Path(curves)), [read_noise_model(Path(model)) for model in models])


def read_trial(files: Mapping[str, Any], given: Mapping[str, Any]) -> Trial:
    """What a rule of the workflow gives for the refits of a case: its inputs and its parameters, by name."""
    case, setting = read_measured_case(files["measured"], files.get("noise", [])), given["setting"]
    mesh, motion = read_mesh(Path(files["mesh"])), read_motion(Path(files["registered"]))
    model = Model(mesh, given["case"].period, given["pressures"], given["scheme"])
    return Trial(case, motion, model, setting, case.target, given["most_steps"])


def write_refit(path: Path, refit: Refit, fingerprint: str) -> None:
    """Write the refit, its parameters by name under "summary"."""
    fields = {name: getattr(refit, name) for name in Refit.__dataclass_fields__}
    summary = {"estimate": refit.parameters}
    write_result(path, {"summary": summary, "refit": fields}, fingerprint, {"estimate": "SI"})


def read_refit(path: Path) -> Refit:
    """What write_refit wrote; raises InputError for a missing or broken file."""
    content: Mapping[str, Any] = read_result(path)["refit"]
    arrays = {name: np.array(content[name]) for name in ("estimate", "covariance", "predicted", "slopes")}
    return Refit(**{**content, **arrays, "names": tuple(content["names"])})


def read_proved(
    name: tuple[str, str],
    cause: Path,
    before: Path,
    after: Path,
    planted: Sequence[tuple[str, float, str]],
    truth: Path,
) -> Proved:
    """A virtual case and setting by ``name`` as the evaluation sees it."""
    none, extended = (read_refit(Path(each)).parameters for each in (before, after))
    return Proved(*name, read_cause(Path(cause)), none, extended, planted, read_truth(Path(truth)))
