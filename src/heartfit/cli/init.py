"""Command that writes the files of a study of one measured heart: its configuration and its row."""

import argparse
import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from heartfit.cli.console import STANDARD, Command
from heartfit.cli.pressure import pressure_arguments, stated_pressure
from heartfit.core.errors import InputError
from heartfit.core.validation import validate
from heartfit.io.files import write_text
from heartfit.study.case import Source

FILL_IN = "FILL_IN"
"""Placeholder of a missing entry; a study that contains it is rejected with its place."""

HEAD = """\
# {case}, a measured heart, over config.yaml. Paths are relative to the working directory; the files are only read.
#   heartfit check {case}                                  lists what is missing or wrong, draws the heart
#   python3 study.py run --configfile config/{case}.yaml   runs the study
results: results/{case}
cases: config/{case}.tsv # one row: period of the beat; conduction: healthy, or lbbb with the QRS duration
settings:
  locking: null # removes a setting of the study
  # biventricular: that of full.yaml with `cases: [{case}]`, which fits the volume of the right ventricle, too
sensitivity:
  case: {case}
discovery:
  walls: [] # or [{case}], which searches the strain of its wall, too: some twenty minutes
"""

BLANK = f"""\
    segmentation: {FILL_IN} # label volume at end diastole
    labels: {{lv_cavity: {FILL_IN}, lv_wall: {FILL_IN}, rv_cavity: {FILL_IN}}} # rv_wall too, if segmented
    images: {FILL_IN} # cine: a 4-D file, or a folder of DICOM
    end_diastole: 0 # frame of the images
    # or, instead of these four lines, one of
    # surfaces: folder of surface meshes, one per phase
    # fit: folder in the layout of a biv-me subject
"""

PRESSURE = """\
    # pressure: # left ventricular pressure, if recorded
    #   file: pressure.csv # with columns such as time_ms, lv_pressure_mmhg, ecg
    #   unit: mmHg # or kPa, if the column's name does not state it
    #   trigger: ecg # column of the ECG or of a marker; without one
    #   # upstroke: 0.08 # s, from the trigger to the steepest rise of the pressure
"""


def study_text(case: str, source: Mapping[str, Any] | None) -> str:
    """Return the configuration in YAML; without a source, with placeholders to fill in."""
    wall = BLANK if source is None else _lines(source)
    pressure = "" if source is not None and "pressure" in source else PRESSURE
    return f"{HEAD.format(case=case)}sources:\n  {case}:\n{wall}{pressure}"


def row_text(
    case: str, period: float | None, conduction: str | None, qrs_ms: float | None, filling: float | None
) -> str:
    """Return the table of cases with one row, from period [s], QRS [ms] and filling pressure [Pa]."""
    cells = (
        case,
        "measured",
        FILL_IN if period is None else f"{period:.4g}",
        conduction or FILL_IN,
        "" if qrs_ms is None else f"{qrs_ms:g}",
        "" if filling is None else f"{1e-3 * filling:.4g}",
    )
    return "case\tkind\tperiod_s\tconduction\tqrs_ms\tedp_kpa\n" + "\t".join(cells) + "\n"


def _lines(source: Mapping[str, Any], indent: str = "    ") -> str:
    """Return a nested table of texts and numbers in YAML, with the quotes of JSON, which are valid in YAML."""
    lines = ""
    for key, value in source.items():
        if isinstance(value, Mapping):
            lines += f"{indent}{key}:\n{_lines(value, indent + '  ')}"
        else:
            lines += f"{indent}{key}: {json.dumps(value, ensure_ascii=False)}\n"
    return lines


CASE_NAME = re.compile(r"[A-Za-z][A-Za-z0-9-]*")


def init_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `init`."""
    command.add_argument("case", metavar="CASE", help="name of the heart: letters, digits and hyphens")
    for option, text in (
        ("--fit", "folder in the layout of a biv-me subject"),
        ("--surfaces", "folder of surface meshes, one per phase"),
        ("--segmentation", "label volume at end diastole, or one per frame"),
        ("--images", "cine: a 4-D file, or a folder"),
    ):
        command.add_argument(option, metavar="PATH", help=text)
    pressure_arguments(command)
    command.add_argument(
        "--labels", help="label numbers of the segmentation: lv_cavity=1,lv_wall=2,rv_cavity=3[,rv_wall=4]"
    )
    command.add_argument(
        "--end-diastole",
        type=int,
        metavar="FRAME",
        help="frame of the images at end diastole, counted from 0",
    )
    command.add_argument(
        "--rr", type=float, metavar="S", help="period of the beat; that of the data if not given"
    )
    command.add_argument(
        "--conduction",
        choices=("healthy", "lbbb"),
        help="conduction of the heart; to be filled in if not given",
    )
    command.add_argument("--qrs", type=float, metavar="MS", help="duration of the QRS complex")


def init(arguments: argparse.Namespace) -> int:
    """Write the configuration and the row of a measured heart; without options, with placeholders to fill in."""
    from heartfit.io.sources import stated_filling, stated_period

    if not CASE_NAME.fullmatch(arguments.case):
        raise InputError(
            f"init: {arguments.case!r}; expected a name of letters, digits and hyphens, a letter first"
        )
    if not STANDARD.is_file():
        raise InputError(f"{STANDARD}: no such file; run init in the folder of the project")
    study, row = (Path(f"config/{arguments.case}.{suffix}") for suffix in ("yaml", "tsv"))
    for file in (study, row):
        if file.exists():
            raise InputError(
                f"{file}: is there already and is left as it is; choose another name or remove it"
            )
    content = _source(arguments)
    source = validate(Source, content, "init") if content else None
    period = arguments.rr if arguments.rr is not None or source is None else stated_period(source)
    filling = None if source is None else stated_filling(source, period)
    write_text(row, row_text(arguments.case, period, arguments.conduction, arguments.qrs, filling))
    write_text(study, study_text(arguments.case, content or None))
    print(f"wrote {study} and {row}\nnext: heartfit check {arguments.case}")
    return 0


def _source(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return the source that the options state, in the form of the configuration."""
    source: dict[str, Any] = {
        name: getattr(arguments, name)
        for name in ("fit", "surfaces", "segmentation", "images", "end_diastole")
    }
    source["labels"] = None if arguments.labels is None else dict(map(_label, arguments.labels.split(",")))
    source["pressure"] = stated_pressure(arguments) or None
    return _without_none(source)


def _without_none(content: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in content.items() if value is not None}


def _label(text: str) -> tuple[str, int]:
    name, _, number = text.partition("=")
    if not number.strip().isdecimal():
        raise InputError(f"--labels {text!r}: expected NAME=NUMBER, as lv_cavity=1,lv_wall=2,rv_cavity=3")
    return name.strip(), int(number)


COMMANDS: tuple[Command, ...] = ((init, init_arguments, "write the configuration of a measured heart"),)
