"""The command that runs one heart."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from heartfit import protocol
from heartfit.catalogue import composed, declared
from heartfit.commands.options import Command, configuration
from heartfit.configuration.setting import Setting
from heartfit.console import Progress, beat_summary
from heartfit.errors import InputError
from heartfit.io.beats import write_beat
from heartfit.io.configuration import read_study
from heartfit.io.fingerprint import fingerprint
from heartfit.io.image_times import BEATS
from heartfit.io.inside import require_writable
from heartfit.io.meshes import read_prepared_mesh


def simulate_arguments(command: argparse.ArgumentParser) -> None:
    """Of `simulate`."""
    configuration(command)
    command.add_argument(
        "mesh", type=Path, help="ventricles (.vtu) at end diastole, as the study builds them"
    )
    command.add_argument("--setting", default="physical", help="a setting of the configuration")
    command.add_argument("--set", nargs="+", default=[], metavar="NAME=VALUE", help="parameters, SI units")
    command.add_argument("--period", type=float, default=0.829, metavar="S", help="duration of a beat")
    command.add_argument(
        "--unloaded", action="store_true", help="the mesh is the stress-free reference already"
    )
    command.add_argument(
        "--output", type=Path, default=Path("beat.json"), help="curves go into the .csv beside it"
    )


def simulate(given: argparse.Namespace) -> int:
    """Run beats of one heart until they are periodic and write the last one."""
    if given.output.suffix == ".csv" or given.output.is_dir():
        raise InputError(
            f"--output {given.output}: expected a file such as beat.json; the curves go into its .csv"
        )
    require_writable(given.output.parent)
    if not BEATS[0] <= given.period <= BEATS[1]:
        raise InputError(
            f"--period {given.period:g}: expected {BEATS[0]:g} to {BEATS[1]:g} s, the length of a beat"
        )
    study = read_study(given.config)
    if given.setting not in study.settings:
        raise InputError(f"no setting {given.setting!r}; known are {', '.join(study.settings)}")
    setting = study.setting(given.setting)
    changed = _changed(given.set, setting)
    if given.unloaded:
        setting = setting.model_copy(update={"reference": "end_diastolic"})
    mesh, pressures = read_prepared_mesh(given.mesh), study.end_diastolic_pressure
    beat = protocol.run_beat(mesh, setting, given.period, changed, pressures, study.numerics, Progress())
    write_beat(given.output, beat, fingerprint(Path(protocol.__file__)))
    print("\n".join([f"{len(mesh.tets)} tetrahedra, {setting.element}", *beat_summary(beat)]))
    return 0 if beat.completed else 1


def _changed(given: Sequence[str], setting: Setting) -> dict[str, float]:
    """Parameters from texts NAME=VALUE; raises InputError for one that stands twice or that the setting lacks."""
    changed: dict[str, float] = {}
    for text in given:
        name, value = _assignment(text)
        if name in changed:
            raise InputError(f"--set {text}: {name} is set twice; leave one out")
        try:
            composed(setting.mechanisms).with_parameters({name: value})
        except KeyError as unknown:
            known = ", ".join(setting.mechanisms) or "none"
            raise InputError(
                f"--set {text}: {unknown.args[0]}; mechanisms of the setting are {known}: add it there"
            ) from None
        changed[name] = value
    return changed


def _assignment(text: str) -> tuple[str, float]:
    name, _, value = text.partition("=")
    try:
        declared(name)
        return name, float(value)
    except ValueError:
        raise InputError(f"--set {text}: expected NAME=VALUE with a number, as sigma_0=240e3") from None
    except KeyError as unknown:
        raise InputError(f"--set {text}: {unknown.args[0]}") from None


COMMANDS: tuple[Command, ...] = ((simulate, simulate_arguments, "run beats of one heart"),)
