"""The command that writes the configuration of a heart of one's own."""

import argparse
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from heartfit.commands.options import STANDARD, Command
from heartfit.configuration.own_case import row_text, study_text
from heartfit.configuration.source import Source
from heartfit.configuration.strict import validated
from heartfit.errors import InputError
from heartfit.io.atomic import write_text

NAME = re.compile(r"[A-Za-z][A-Za-z0-9-]*")


def init_arguments(command: argparse.ArgumentParser) -> None:
    """The arguments of init."""
    command.add_argument("case", metavar="CASE", help="its name: letters, digits and hyphens")
    for option, text in (
        ("--fit", "folder in the layout of a biv-me subject"),
        ("--surfaces", "folder of surface meshes, one a phase"),
        ("--segmentation", "label volume at end diastole, or one for each frame"),
        ("--images", "cine: a 4-D file, or a folder"),
        ("--pressure", "CSV of the left ventricle's pressure"),
        ("--pressure-column", "its column, where there are several"),
        ("--trigger", "column of the ECG or of a marker in the CSV"),
    ):
        command.add_argument(
            option, metavar="PATH" if "CSV" not in text and "column" not in text else None, help=text
        )
    command.add_argument(
        "--labels", help="of the segmentation: lv_cavity=1,lv_wall=2,rv_cavity=3[,rv_wall=4]"
    )
    command.add_argument("--end-diastole", type=int, metavar="FRAME", help="of the images, counted from 0")
    command.add_argument(
        "--pressure-unit", choices=("mmHg", "kPa"), help="where the column's name does not say it"
    )
    command.add_argument(
        "--upstroke", type=float, metavar="S", help="after the trigger, where no column says it"
    )
    command.add_argument(
        "--rr", type=float, metavar="S", help="length of the beat; what the data say if not given"
    )
    command.add_argument(
        "--conduction", choices=("healthy", "lbbb"), help="of the heart; to be filled in if not given"
    )
    command.add_argument("--qrs", type=float, metavar="MS", help="duration of the QRS complex")


def init(given: argparse.Namespace) -> int:
    """Write the configuration and the row of a measured heart; without options, to be filled in by hand."""
    from heartfit.io.sources import stated_filling, stated_period

    if not NAME.fullmatch(given.case):
        raise InputError(
            f"init: {given.case!r}; expected a name of letters, digits and hyphens, a letter first"
        )
    if not STANDARD.is_file():
        raise InputError(f"{STANDARD}: no such file; run init in the folder of the project")
    study, row = (Path(f"config/{given.case}.{suffix}") for suffix in ("yaml", "tsv"))
    for file in (study, row):
        if file.exists():
            raise InputError(
                f"{file}: is there already and is left as it is; choose another name or remove it"
            )
    content = _source(given)
    source = validated(Source, content, "init") if content else None
    period = given.rr if given.rr is not None or source is None else stated_period(source)
    filling = None if source is None else stated_filling(source, period)
    write_text(row, row_text(given.case, period, given.conduction, given.qrs, filling))
    write_text(study, study_text(given.case, content or None))
    print(f"wrote {study} and {row}\nnext: heartfit check {given.case}")
    return 0


def _source(given: argparse.Namespace) -> dict[str, Any]:
    """What the options say of the data, as the configuration says it."""
    said = {
        name: getattr(given, name) for name in ("fit", "surfaces", "segmentation", "images", "end_diastole")
    }
    said["labels"] = None if given.labels is None else dict(map(_label, given.labels.split(",")))
    pressure = {
        "file": given.pressure,
        "unit": given.pressure_unit,
        "column": given.pressure_column,
        "trigger": given.trigger,
        "upstroke": given.upstroke,
    }
    said["pressure"] = _without_none(pressure) or None
    return _without_none(said)


def _without_none(content: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in content.items() if value is not None}


def _label(text: str) -> tuple[str, int]:
    name, _, number = text.partition("=")
    if not number.strip().isdecimal():
        raise InputError(f"--labels {text!r}: expected NAME=NUMBER, as lv_cavity=1,lv_wall=2,rv_cavity=3")
    return name.strip(), int(number)


COMMANDS: tuple[Command, ...] = ((init, init_arguments, "write the configuration of a heart of your own"),)
