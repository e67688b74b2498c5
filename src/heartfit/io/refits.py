"""Refits of the 3-D heart with and without an extension, as JSON."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from heartfit.discovery.refit.model import Model
from heartfit.discovery.refit.prove import ExtensionTrial
from heartfit.discovery.refit.refit import Refit
from heartfit.discovery.refit.target import MeasuredCase
from heartfit.discovery.sphere_model.cause import Attempt
from heartfit.io.curves import read_curves
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.noise_models import read_noise_model
from heartfit.io.results import read_record, write_result
from heartfit.observation.curve import Curve
from heartfit.observation.second_reading import Reading


def write_attempt(path: Path, attempt: Attempt, fingerprint: str) -> None:
    """Write an attempt; a missing evidence becomes null."""
    write_result(path, attempt, fingerprint, {"sizes": "SI", "traces": "SI"})


def read_attempt(path: Path) -> Attempt:
    """Read an attempt; raises InputError for a missing or broken file."""
    return read_record(Path(path), Attempt)


def read_measured_case(files: Mapping[str, Any], reading: Reading = "mean") -> MeasuredCase:
    """Read a case: measured curves, noise model of its images and second reading, as far as it has them.

    reading: of a left volume that was read twice.
    """
    models = [read_noise_model(Path(model)) for model in files.get("noise", [])]
    seconds = list(map(read_left_volume, files.get("second", [])))
    second = seconds[0] if seconds else None
    return MeasuredCase.from_curves(read_curves(Path(files["measured"])), models, second, reading)


def read_left_volume(path: Path) -> Curve:
    """Read the left ventricular volume of a file of curves."""
    return read_curves(Path(path))["lv_volume"]


def read_trial(files: Mapping[str, Any], parameters: Mapping[str, Any]) -> ExtensionTrial:
    """Trial of the refits of a case, by the inputs and parameters of a rule of the workflow."""
    case, setting = read_measured_case(files), parameters["setting"]
    mesh, motion = read_mesh(Path(files["mesh"])), read_motion(Path(files["registered"]))
    model = Model(mesh, parameters["case"].period, parameters["pressures"], parameters["scheme"])
    return ExtensionTrial(
        case, motion, model, setting, case.target, case.complete_target, parameters["most_steps"]
    )


def write_refit(path: Path, refit: Refit, fingerprint: str) -> None:
    """Write a refit, with its parameters by name under "summary"."""
    content = {"summary": {"estimate": refit.parameters}, "refit": refit}
    write_result(path, content, fingerprint, {"estimate": "SI"})


def read_refit(path: Path) -> Refit:
    """Read a refit; raises InputError for a missing or broken file."""
    return read_record(path, Refit, "refit")
