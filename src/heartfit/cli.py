"""The console command heartfit, for people without Snakemake."""

import sys
from collections.abc import Sequence

from heartfit.commands import campaign, check, diagnose, init, pages, simulate
from heartfit.console import Parser, refusal
from heartfit.errors import InputError
from heartfit.io.made_by import made_by

SUBJECTS = (simulate, init, check, diagnose, campaign, pages)


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out a command; 0 if it did, 1 if the simulation failed, 2 for bad input, said in one line."""
    try:
        given = _parser().parse_args(arguments)
        return int(given.carry_out(given))
    except (InputError, OSError, MemoryError) as problem:
        print(f"heartfit: {refusal(problem)}", file=sys.stderr)
        return 2


def _parser() -> Parser:
    parser = Parser(prog="heartfit", description=__doc__)
    parser.add_argument(
        "--version", action="version", version=made_by(), help="of everything a result depends on"
    )
    commands = parser.add_subparsers(required=True, metavar="command")
    for carry_out, arguments, text in (each for subject in SUBJECTS for each in subject.COMMANDS):
        name = carry_out.__name__.replace("_", "-")
        command = commands.add_parser(name, help=text, description=carry_out.__doc__)
        command.set_defaults(carry_out=carry_out)
        arguments(command)
    return parser
