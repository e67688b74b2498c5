"""Console command heartfit, for use without Snakemake."""

import sys
from argparse import Action, ArgumentParser
from collections.abc import Sequence

from heartfit.cli import campaign, check, diagnose, init, pages, simulate, wall
from heartfit.cli.console import Parser, refusal
from heartfit.core.errors import InputError
from heartfit.io.fingerprint import made_by

SUBJECTS = (simulate, init, check, diagnose, wall, campaign, pages)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; return 0 for success, 1 for a failed simulation, 2 for invalid input, reported in one line."""
    try:
        namespace = command_parser().parse_args(arguments)
        return int(namespace.carry_out(namespace))
    except (InputError, OSError, MemoryError) as problem:
        print(f"heartfit: {refusal(problem)}", file=sys.stderr)
        return 2


class _PrintVersions(Action):
    """Reads the versions only when they are asked for."""

    def __call__(self, parser: ArgumentParser, *_: object) -> None:
        print(made_by())
        parser.exit()


def command_parser() -> Parser:
    """Return the parser of all commands, which also writes the reference page docs/command_line.md."""
    parser = Parser(prog="heartfit", description=__doc__)
    parser.add_argument(
        "--version",
        action=_PrintVersions,
        nargs=0,
        help="print the versions of all software that a result depends on",
    )
    commands = parser.add_subparsers(required=True, metavar="command")
    for carry_out, add_arguments, text in (command for subject in SUBJECTS for command in subject.COMMANDS):
        name = carry_out.__name__.replace("_", "-")
        command = commands.add_parser(name, help=text, description=carry_out.__doc__)
        command.set_defaults(carry_out=carry_out)
        add_arguments(command)
    return parser
