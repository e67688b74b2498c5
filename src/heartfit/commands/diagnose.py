"""Commands that name what a simulation gets wrong, and hand on the models that were tried."""

import argparse
from pathlib import Path

from heartfit.commands.options import Command
from heartfit.io.fingerprint import fingerprint
from heartfit.io.inside import require_writable


def diagnose_arguments(command: argparse.ArgumentParser) -> None:
    """Of `diagnose`."""
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


def petab_select_arguments(command: argparse.ArgumentParser) -> None:
    """Of `petab-select`."""
    command.add_argument("cause", type=Path, help="folder of a cause card")
    command.add_argument("-o", "--output", type=Path, default=Path("petab_select"), help="folder to write to")


def petab_select(given: argparse.Namespace) -> int:
    """write the models that a diagnosis tried, with their criteria, as a problem of PEtab Select"""
    from heartfit.io.model_space import write_model_space

    print(
        write_model_space(given.output, given.cause / "cause.json"), f"See {given.output / 'problem.yaml'}."
    )
    return 0


COMMANDS: tuple[Command, ...] = (
    (diagnose, diagnose_arguments, "name what a simulation of a recorded heart gets wrong"),
    (petab_select, petab_select_arguments, "write the models that a diagnosis tried for PEtab Select"),
)
