"""Commands that diagnose a recorded heart and run Python files with further mechanisms."""

import argparse
import sys
from collections.abc import Iterable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from traceback import extract_tb

from heartfit.cli.console import Command
from heartfit.cli.pressure import pressure_arguments, stated_pressure
from heartfit.core.errors import InputError
from heartfit.io.files import require_writable
from heartfit.io.fingerprint import fingerprint
from heartfit.roles import registered, require_registered


def run_mechanism_files(paths: Iterable[Path]) -> list[str]:
    """Run files that declare mechanisms; return the names of the newly registered mechanisms.

    Raises InputError for a missing file, a failing one (with the line), and one that registers nothing.
    """
    return [name for path in paths for name in _run(path)]


def _run(path: Path) -> list[str]:
    if not path.is_file() or path.suffix != ".py":
        raise InputError(
            f"{path}: no file of Python; expected one that declares a mechanism: correct the path"
        )
    earlier = registered()
    try:
        _import(path)
    except Exception as problem:  # a user's file may raise any exception
        raise InputError(f"{path}{_line(path, problem)}: {type(problem).__name__}: {problem}") from problem
    new = [name for name in registered() if name not in earlier]
    if not new:
        raise InputError(f"{path}: declares no mechanism; expected a class decorated with @mechanism")
    return new


def _import(path: Path) -> None:
    spec = spec_from_file_location(f"_mechanism_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise ImportError("cannot be imported")
    module = module_from_spec(spec)
    sys.modules[module.__name__] = module  # dataclasses resolve annotations there
    spec.loader.exec_module(module)


def _line(path: Path, problem: Exception) -> str:
    """Return the last line of the file in the traceback as text."""
    lines = [frame.lineno for frame in extract_tb(problem.__traceback__) if frame.filename == str(path)]
    return f", line {lines[-1]}" if lines else ""


def diagnose_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `diagnose`."""
    command.add_argument(
        "measured",
        type=Path,
        help="curves (.csv): time_s or time_ms, lv_volume_ml, and lv_pressure_kpa, aortic_pressure_kpa (or _mmhg), "
        "rv_volume_ml, rv_pressure_kpa if measured",
    )
    pressure_arguments(command)
    command.add_argument(
        "--condition",
        nargs="+",
        default=[],
        metavar="NAME=CSV",
        help="curves of the same heart under another loading, held out from the fit",
    )
    command.add_argument(
        "--rr", type=float, metavar="S", help="period of the beat; that of the file if not given"
    )
    command.add_argument(
        "--mechanism",
        type=Path,
        nargs="+",
        default=[],
        metavar="PY",
        help="Python files that declare further mechanisms; they are run",
    )
    command.add_argument(
        "--without",
        nargs="+",
        default=[],
        metavar="NAME",
        help="mechanisms of the library that are not tried, as MitralRegurgitation",
    )
    command.add_argument(
        "--strict", action="store_true", help="name nothing below a ln Bayes factor of 10 instead of 5"
    )
    _structure_arguments(command)
    command.add_argument(
        "--write-mechanism",
        type=Path,
        metavar="PY",
        help="write the law of an unknown effect as a file that --mechanism takes",
    )
    command.add_argument("-o", "--output", type=Path, default=Path("cause"), help="folder of the cause card")


def _structure_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments that say what the simulation may leave of a healthy heart."""
    structure = command.add_mutually_exclusive_group()
    structure.add_argument(
        "--against",
        type=Path,
        metavar="CSV",
        help="earlier curves of the same heart: name what has changed since",
    )
    structure.add_argument(
        "--reference",
        type=Path,
        metavar="FOLDER",
        help="curves of healthy controls, a CSV each: what the simulation leaves of them is no finding",
    )
    structure.add_argument(
        "--trust-simulator",
        action="store_true",
        help="for data of this simulator: allow for no difference between it and the source of the curves",
    )
    command.add_argument(
        "--places",
        action=argparse.BooleanOptionalAction,
        help="locate an unknown effect by free functions inside the equations; if neither is stated, only with "
        "--trust-simulator",
    )


def diagnose(arguments: argparse.Namespace) -> int:
    """Name the mechanism that a simulation of a recorded heart lacks, within a minute."""
    from heartfit.api import diagnosis
    from heartfit.cli.diagnose import run_mechanism_files
    from heartfit.core.validation import validate
    from heartfit.discovery.sphere_model.consistency import implausible
    from heartfit.discovery.sphere_model.diagnose import diagnose_change
    from heartfit.io.causes import write_cause_card
    from heartfit.io.files import write_text
    from heartfit.io.pressures import read_pressure
    from heartfit.io.recordings import read_conditions, read_recording
    from heartfit.io.structure import read_controls
    from heartfit.places import PLACES
    from heartfit.results.cause_figure import render_cause
    from heartfit.results.mechanism_file import mechanism_file
    from heartfit.results.verdict_text import candidate_sentence, verdict_sentence
    from heartfit.study.case import RecordedPressure

    run_mechanism_files(arguments.mechanism)
    _require_consistent(arguments)
    recording = read_recording(arguments.measured, arguments.rr)
    if stated := stated_pressure(arguments):
        source = validate(RecordedPressure, stated, "diagnose")
        recording = recording.with_pressure(read_pressure(source, recording.period).curve)
    conditions = read_conditions(arguments.condition, recording.period)
    require_writable(arguments.output)
    known = implausible(recording, str(arguments.measured))
    _print_warnings(known, arguments.measured)
    if arguments.against:
        before = read_recording(arguments.against)
        _print_warnings(implausible(before, str(arguments.against)), arguments.against)
        conclusion = diagnose_change(recording, before)
    else:
        conclusion = diagnosis.diagnose(
            recording,
            conditions,
            trust_simulator=arguments.trust_simulator,
            controls=read_controls(arguments.reference) if arguments.reference else None,
            places={None: None, True: PLACES, False: ()}[arguments.places],
            strict=arguments.strict,
            without=arguments.without,
        )
    _print_warnings([line for line in conclusion.warnings if line not in known], arguments.measured)
    code = fingerprint(Path(diagnosis.__file__))
    write_cause_card(arguments.output, render_cause(conclusion, arguments.measured.stem), code)
    sentences = [verdict_sentence(conclusion)]
    sentences += [candidate_sentence(conclusion)] if conclusion.candidate else []
    print(f"{' '.join(sentences)} See {arguments.output / 'cause.md'} and {arguments.output / 'cause.png'}.")
    if arguments.write_mechanism:
        write_text(arguments.write_mechanism, mechanism_file(conclusion, arguments.measured.stem))
    return 0


def _require_consistent(arguments: argparse.Namespace) -> None:
    located = arguments.places is not None
    if arguments.against and (arguments.condition or arguments.strict or arguments.without or located):
        raise InputError(
            "--against compares two recordings; expected it without --condition, --without, --strict and --places: "
            "leave them out"
        )
    for name in arguments.without:
        try:
            require_registered(name)
        except KeyError as unknown:
            raise InputError(f"--without: {unknown.args[0]}") from unknown


def _print_warnings(lines: Iterable[str], file: Path) -> None:
    for line in lines:
        print(f"{file}: warning: {line}", file=sys.stderr)


def petab_select_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `petab-select`."""
    command.add_argument("cause", type=Path, help="folder of a cause card")
    command.add_argument("-o", "--output", type=Path, default=Path("petab_select"), help="folder to write to")


def petab_select(arguments: argparse.Namespace) -> int:
    """Write the models that a diagnosis tried, with their criteria, as a PEtab Select problem."""
    from heartfit.io.causes import read_tried
    from heartfit.io.exchange import write_model_space
    from heartfit.results.model_space import build_model_space

    cause = read_tried(arguments.cause / "cause.json")
    space = build_model_space(cause.tried, cause.threshold, cause.samples)
    write_model_space(arguments.output, space)
    choice = f"{space.choice} has the lowest criterion, the verdict is {cause.verdict}"
    print(f"{len(cause.tried)} models; {choice}. See {arguments.output / 'problem.yaml'}.")
    return 0


COMMANDS: tuple[Command, ...] = (
    (diagnose, diagnose_arguments, "name the mechanism that a simulation of a recorded heart lacks"),
    (petab_select, petab_select_arguments, "write the models that a diagnosis tried for PEtab Select"),
)
