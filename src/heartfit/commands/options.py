"""Options that several commands have."""

import argparse
from collections.abc import Callable
from pathlib import Path

STANDARD = Path("config/config.yaml")

Command = tuple[Callable[[argparse.Namespace], int], Callable[[argparse.ArgumentParser], None], str]


def configuration(command: argparse.ArgumentParser) -> None:
    """``--config``: the files of a study, later ones over earlier ones; the standard one if none is given."""
    command.add_argument(
        "--config",
        type=Path,
        nargs="+",
        default=[STANDARD],
        metavar="YAML",
        help="later ones over earlier ones",
    )


def nothing(_: argparse.ArgumentParser) -> None:
    """No argument."""
