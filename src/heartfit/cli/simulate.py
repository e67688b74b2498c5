"""Command that simulates one heart."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from heartfit.cli.console import Command, Progress, add_configuration, beat_summary
from heartfit.core.errors import InputError
from heartfit.core.periodic import BEATS
from heartfit.io.beats import write_beat
from heartfit.io.configuration import read_study
from heartfit.io.files import require_writable
from heartfit.io.fingerprint import fingerprint
from heartfit.io.meshes import read_prepared_mesh
from heartfit.personalise import run as protocol
from heartfit.personalise.setting import Setting, compose_heart, declaration


def simulate_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `simulate`."""
    add_configuration(command)
    command.add_argument(
        "mesh", type=Path, help="ventricles (.vtu) at end diastole, as the study builds them"
    )
    command.add_argument("--setting", default="physical", help="name of a setting of the configuration")
    command.add_argument("--set", nargs="+", default=[], metavar="NAME=VALUE", help="parameters, SI units")
    command.add_argument("--period", type=float, default=0.829, metavar="S", help="duration of a beat")
    command.add_argument("--unloaded", action="store_true", help="take the mesh as the stress-free reference")
    command.add_argument(
        "--output",
        type=Path,
        default=Path("beat.json"),
        help="file of the beat; its curves are written to a .csv of the same name",
    )


def simulate(arguments: argparse.Namespace) -> int:
    """Run beats of one heart until they are periodic and write the last one."""
    if arguments.output.suffix == ".csv" or arguments.output.is_dir():
        raise InputError(
            f"--output {arguments.output}: expected a file such as beat.json; "
            "its curves are written to a .csv of the same name"
        )
    require_writable(arguments.output.parent)
    if not BEATS[0] <= arguments.period <= BEATS[1]:
        raise InputError(
            f"--period {arguments.period:g}: expected {BEATS[0]:g} to {BEATS[1]:g} s, the period of a beat"
        )
    study = read_study(arguments.config)
    if arguments.setting not in study.settings:
        raise InputError(f"no setting {arguments.setting!r}; known are {', '.join(study.settings)}")
    setting = study.setting(arguments.setting)
    overrides = _overrides(arguments.set, setting)
    if arguments.unloaded:
        setting = setting.model_copy(update={"reference": "end_diastolic"})
    mesh, pressures = read_prepared_mesh(arguments.mesh), study.end_diastolic_pressure
    beat = protocol.run_beat(
        mesh, setting, arguments.period, overrides, pressures, study.numerics, Progress()
    )
    write_beat(arguments.output, beat, fingerprint(Path(protocol.__file__)))
    print("\n".join([f"{len(mesh.tets)} tetrahedra, {setting.element}", *beat_summary(beat)]))
    return 0 if beat.completed else 1


def _overrides(assignments: Sequence[str], setting: Setting) -> dict[str, float]:
    """Return the parameters of texts NAME=VALUE; raise InputError for a repeated name or one that the setting lacks."""
    overrides: dict[str, float] = {}
    for text in assignments:
        name, value = _assignment(text)
        if name in overrides:
            raise InputError(f"--set {text}: {name} is set twice; expected one value: leave one out")
        try:
            compose_heart(setting.mechanisms).with_parameters({name: value})
        except KeyError as unknown:
            known = ", ".join(setting.mechanisms) or "none"
            raise InputError(
                f"--set {text}: {unknown.args[0]}; mechanisms of the setting are {known}: add it there"
            ) from None
        overrides[name] = value
    return overrides


def _assignment(text: str) -> tuple[str, float]:
    name, _, value = text.partition("=")
    try:
        declaration(name)
        return name, float(value)
    except ValueError:
        raise InputError(f"--set {text}: expected NAME=VALUE with a number, as sigma_0=240e3") from None
    except KeyError as unknown:
        raise InputError(f"--set {text}: {unknown.args[0]}") from None


COMMANDS: tuple[Command, ...] = ((simulate, simulate_arguments, "run beats of one heart"),)
