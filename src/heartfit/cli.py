"""The console command heartfit, for people without Snakemake."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from heartfit import protocol
from heartfit.campaign import COMMANDS
from heartfit.catalogue import composed, declared
from heartfit.checking import check, check_arguments
from heartfit.configuration.setting import Setting
from heartfit.console import Parser, Progress, beat_summary, refusal
from heartfit.errors import InputError
from heartfit.geometry.mesh import VentricularMesh
from heartfit.io.beats import write_beat
from heartfit.io.configuration import read_study
from heartfit.io.fingerprint import fingerprint
from heartfit.io.image_times import BEATS
from heartfit.io.inside import require_writable
from heartfit.io.made_by import made_by
from heartfit.io.meshes import read_mesh
from heartfit.own_case import STANDARD, init, init_arguments
from heartfit.pages import PAGES


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out a command; 0 if it did, 1 if the simulation failed, 2 for bad input, said in one line."""
    try:
        given = _parser().parse_args(arguments)
        return int(given.carry_out(given))
    except (InputError, OSError, MemoryError) as problem:
        print(f"heartfit: {refusal(problem)}", file=sys.stderr)
        return 2


def _parser() -> argparse.ArgumentParser:
    parser = Parser(prog="heartfit", description=__doc__)
    parser.add_argument(
        "--version", action="version", version=made_by(), help="of everything a result depends on"
    )
    commands = parser.add_subparsers(required=True, metavar="command")
    simulated = commands.add_parser("simulate", help="run beats of one heart", description=simulate.__doc__)
    _simulate_arguments(simulated)
    for carry_out, arguments, text in (
        (init, init_arguments, "write the configuration of a heart of your own"),
        (check, check_arguments, "say all that is wrong with a study before it runs"),
        *COMMANDS,
    ):
        arguments(commands.add_parser(carry_out.__name__, help=text, description=carry_out.__doc__))
    for page in PAGES:
        command = commands.add_parser(page.__name__.replace("_", "-"), help=page.__doc__)
        command.set_defaults(carry_out=page)
    held = commands.add_parser("tolerances", help=tolerances.__doc__)
    held.set_defaults(carry_out=tolerances)
    held.add_argument("numbers", type=Path, help="numbers.csv of a study")
    held.add_argument(
        "table", type=Path, help="the tolerances whose expected numbers are to be those of the study"
    )
    _diagnose_arguments(commands.add_parser("diagnose", help=diagnose.__doc__, description=diagnose.__doc__))
    space = commands.add_parser("petab-select", help=petab_select.__doc__)
    space.set_defaults(carry_out=petab_select)
    space.add_argument("cause", type=Path, help="folder of a cause card")
    space.add_argument("-o", "--output", type=Path, default=Path("petab_select"), help="folder to write to")
    compared = commands.add_parser("reference", help=reference.__doc__)
    compared.set_defaults(carry_out=reference)
    compared.add_argument(
        "mesh", type=Path, help="ventricles (.vtu) at end diastole, as the study builds them"
    )
    return parser


def _simulate_arguments(command: argparse.ArgumentParser) -> None:
    command.set_defaults(carry_out=simulate)
    command.add_argument(
        "--config",
        type=Path,
        nargs="+",
        default=[STANDARD],
        metavar="YAML",
        help="later ones over earlier ones",
    )
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


def _diagnose_arguments(command: argparse.ArgumentParser) -> None:
    command.set_defaults(carry_out=diagnose)
    command.add_argument(
        "measured",
        type=Path,
        help="curves (.csv): time_s, lv_volume_ml, and lv_pressure_kpa, rv_volume_ml, aortic_pressure_kpa if measured",
    )
    command.add_argument(
        "--condition",
        nargs="+",
        default=[],
        metavar="NAME=CSV",
        help="the same heart under another loading, held out",
    )
    command.add_argument(
        "--rr", type=float, metavar="S", help="period of the beat; that which the file states if not given"
    )
    command.add_argument(
        "--mechanism",
        type=Path,
        nargs="+",
        default=[],
        metavar="PY",
        help="files of Python, which are run: they declare mechanisms to search as well",
    )
    command.add_argument(
        "--strict", action="store_true", help="name nothing below a ln Bayes factor of 10 instead of 5"
    )
    command.add_argument("-o", "--output", type=Path, default=Path("cause"), help="folder of the cause card")


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
    mesh, pressures = _prepared(given.mesh), study.end_diastolic_pressure
    beat = protocol.run_beat(mesh, setting, given.period, changed, pressures, study.numerics, Progress())
    write_beat(given.output, beat, fingerprint(Path(protocol.__file__)))
    print("\n".join([f"{len(mesh.tets)} tetrahedra, {setting.element}", *beat_summary(beat)]))
    return 0 if beat.completed else 1


def _prepared(file: Path) -> VentricularMesh:
    """The mesh with the fields that a beat needs; raises InputError where one is missing."""
    mesh = read_mesh(file)
    for name in ("fibres", "activation", "segments"):
        if getattr(mesh, name) is None:
            raise InputError(
                f"{file}: no cell field {name}; expected a mesh as the study builds it: build it again"
            )
    return mesh


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


def diagnose(given: argparse.Namespace) -> int:
    """name what a simulation of a recorded heart gets wrong, within a minute"""
    from heartfit.diagnosis import diagnose as diagnosis  # with what no other command needs
    from heartfit.discovery.rules import RULES, STRICT
    from heartfit.io.causes import write_cause_card
    from heartfit.io.mechanism_files import run_mechanism_files
    from heartfit.io.recordings import read_conditions, read_recording

    run_mechanism_files(given.mechanism)
    recording = read_recording(given.measured, given.rr)
    conditions = read_conditions(given.condition, recording.period)
    require_writable(given.output)
    found = diagnosis.diagnose(recording, conditions, rules=STRICT if given.strict else RULES)
    print(write_cause_card(given.output, found, given.measured.stem, fingerprint(Path(diagnosis.__file__))))
    return 0


def tolerances(given: argparse.Namespace) -> int:
    """Print a table of tolerances with the numbers of a study as the expected ones."""
    from heartfit.io.tables import read_numbers, read_tolerances  # pandas, which no other command needs
    from heartfit.tables.drift import renewed

    table = renewed(read_numbers(given.numbers), read_tolerances(given.table))
    print(table.to_csv(sep="\t", index=False, float_format="%.4g"), end="")
    return 0


def petab_select(given: argparse.Namespace) -> int:
    """write the models that a diagnosis tried, with their criteria, as a problem of PEtab Select"""
    from heartfit.io.model_space import write_model_space

    print(
        write_model_space(given.output, given.cause / "cause.json"), f"See {given.output / 'problem.yaml'}."
    )
    return 0


def reference(given: argparse.Namespace) -> int:
    """print what the choice of the stress-free reference does to the beat of a mesh, in some minutes"""
    from heartfit.verification.reference import find
    from heartfit.verification.reference_checks import reference_table

    study = read_study([STANDARD])
    loads = np.array([study.end_diastolic_pressure.lv, study.end_diastolic_pressure.rv])
    print(reference_table(find(_prepared(given.mesh), loads, study.numerics.numerics())), end="")
    return 0
