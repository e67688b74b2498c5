"""Write docs/command_line.md from the parsers of the command line, or compare it with them.

python docs/command_line.py            write the page
python docs/command_line.py --check    write nothing; fail if the page differs from `heartfit --help`
"""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

from heartfit.cli.main import command_parser

PAGE = Path(__file__).with_name("command_line.md")
HEAD = """# Command line

Every command of `heartfit`, as `heartfit COMMAND --help` prints it. `python docs/command_line.py` writes this page.
A command ends with 0 for success, 1 for a failed simulation and 2 for invalid input, which it refuses in
[one line](errors.md). `heartfit --version` prints the versions of all software that a result depends on. The commands
of `study.py` are in [run the study](run_the_study.md).
"""


def page() -> str:
    """The reference page in Markdown: a section per command, with its arguments."""
    commands = dict(_commands(command_parser()))
    return HEAD + "".join(map(_section, commands.values()))


def _commands(parser: argparse.ArgumentParser) -> Iterator[tuple[str, argparse.ArgumentParser]]:
    """Commands by name."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            yield from ((name, command) for name, command in action.choices.items())


def _section(command: argparse.ArgumentParser) -> str:
    arguments = [action for action in command._actions if action.dest != "help"]
    positional = [action for action in arguments if not action.option_strings]
    options = [action for action in arguments if action.option_strings]
    title = " ".join([command.prog, *map(_value, positional)])
    lines = "".join(f"- `{_name(action)}`: {action.help}\n" for action in (*positional, *options))
    return f"\n## {title}\n\n{command.description}\n" + (f"\n{lines}" if lines else "")


def _name(action: argparse.Action) -> str:
    """An argument with its value: "-o, --output OUTPUT"."""
    return " ".join(filter(None, [", ".join(action.option_strings), _value(action)]))


def _value(action: argparse.Action) -> str:
    """The value of an argument, "NAME=CSV ..." for several; empty for a flag."""
    if action.nargs == 0:
        return ""
    name = action.metavar or ("|".join(map(str, action.choices)) if action.choices else action.dest.upper())
    return {"+": f"{name} ...", "?": f"[{name}]"}.get(str(action.nargs), str(name))


def main(arguments: list[str]) -> int:
    """Carry out what the module's docstring lists."""
    if arguments == ["--check"]:
        current = PAGE.read_text(encoding="utf-8") == page()
        sys.stdout.write("" if current else "docs/command_line.md: run python docs/command_line.py\n")
        return int(not current)
    PAGE.write_text(page(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
