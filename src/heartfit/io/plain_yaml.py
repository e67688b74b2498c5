"""YAML of tables, lists, text and numbers alone: what it may say besides is refused before anything is made of it.

Tags ask for objects, and an alias may stand for a list of lists of aliases that fills the memory.
"""

import re
from collections.abc import Hashable, Iterable
from pathlib import Path
from typing import Any

import yaml

from heartfit.errors import InputError
from heartfit.io.text import read_text

EXPECTED = "a configuration in YAML"
DEEPEST = 20
"""Tables within tables; a study has four."""

OTHERWISE = re.compile(r".*[_:].*|[-+]?0[0-9bx].*")
"""Numbers that are read otherwise than they look: 010 as 8, 1:30 as 90, 1_0 as 10."""


class PlainLoader(yaml.SafeLoader):  # type: ignore[misc]
    """Reads plain tables whose keys stand once."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        """The table; raises YAMLError for a key that stands twice."""
        keys = [key.value for key, _ in node.value]
        for number, key in enumerate(keys):
            if isinstance(key, str) and key in keys[:number]:
                raise yaml.YAMLError(f"key {key} stands in one table twice, line {node.start_mark.line + 1}")
        return super().construct_mapping(node, deep)

    def construct_number(self, node: yaml.ScalarNode) -> float:
        """The number; raises YAMLError for one that is read otherwise than it looks."""
        number: float = yaml.SafeLoader.yaml_constructors[node.tag](self, node)
        if OTHERWISE.fullmatch(node.value):
            raise yaml.YAMLError(
                f"{node.value}, line {node.start_mark.line + 1}, is read as {number}: write plain digits"
            )
        return number


PlainLoader.add_constructor("tag:yaml.org,2002:int", PlainLoader.construct_number)
PlainLoader.add_constructor("tag:yaml.org,2002:float", PlainLoader.construct_number)


def read_yaml(path: Path) -> Any:
    """What the file says, None if nothing.

    Raises InputError for what is no text, not YAML, nested too deeply, or more than plain tables.
    """
    text = read_text(path, EXPECTED)
    try:
        _require_plain(yaml.parse(text, yaml.SafeLoader))
        return PlainLoader(text).get_single_data()
    except (yaml.YAMLError, ValueError) as fault:  # ValueError: a day that is none, a number of 5000 digits
        raise InputError(f"{path}: not YAML: {' '.join(str(fault).split())}; correct it") from None


def _require_plain(events: Iterable[yaml.Event]) -> None:
    depth = 0
    for event in events:
        line = event.start_mark.line + 1
        if isinstance(event, yaml.AliasEvent):
            raise yaml.YAMLError(
                f"an alias, *{event.anchor}, line {line}, is not read: write out what it stands for"
            )
        if getattr(event, "tag", None) is not None:
            raise yaml.YAMLError(
                f"a tag, {event.tag}, line {line}, is not read: write plain text or a number"
            )
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
        if depth > DEEPEST:
            raise yaml.YAMLError(f"nested more than {DEEPEST} times, line {line}")
