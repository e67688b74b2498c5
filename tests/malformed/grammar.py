"""Random malformed input: sound input with one mistake, as people and programs make it."""

import re
from collections.abc import Iterator
from typing import Any

import yaml
from hypothesis import strategies as st

from heartfit.study.study import Study
from tests.malformed.sound import CASES, CONFIGURATION, recording

SOUND = yaml.safe_load(CONFIGURATION)
SCHEMA = Study.model_json_schema()
WORDS = [
    "",
    "many",
    "0,5",
    "1.2.3",
    "--1",
    "1e",
    "nan",
    "-inf",
    "1e999",
    "0x10",
    "1_0",
    "7 mm",
    "\u0663",
    "=1+1",
    "NULL",
]
"""Invalid contents of cells that need a finite number; the empty one where a number is required."""

INVALID: dict[type, list[Any]] = {
    int: ["many", "1,5", [], {}, True, float("nan"), float("inf"), [3], {"a": 3}],
    float: ["many", "0,5", [], {}, True, float("nan"), float("-inf"), [0.1], {"a": 0.1}],
    str: [3, 0.5, [], {}, True, None, ["a"], {"a": "b"}],
    list: [3, "many", {"a": 1}, True, [[1]], [None]],
    dict: [3, 0.5, "many", [], [1], True],
}
"""Values of another kind than the present one."""

Place = tuple[str, ...]


def places(table: dict[str, Any], above: Place = ()) -> Iterator[Place]:
    """Every key of a configuration."""
    for key, value in table.items():
        yield (*above, key)
        if isinstance(value, dict):
            yield from places(value, (*above, key))


def value_at(place: Place) -> Any:
    value: Any = SOUND
    for key in place:
        value = value[key]
    return value


def over(place: Place, value: Any) -> str:
    """Configuration with one value, to be laid over the sound one."""
    for key in reversed(place):
        value = {key: value}
    return yaml.safe_dump(value)


KEYS = [place for place in places(SOUND) if type(value_at(place)) in INVALID]


def is_whole(place: Place) -> bool:
    """True where an integer is declared, and not a float that is written as one."""
    declared = SCHEMA
    for key in place:
        name = declared.get("$ref", "").rpartition("/")[2]
        declared = SCHEMA["$defs"].get(name, declared).get("properties", {}).get(key, {})
    return declared.get("type") == "integer"


def wrong_at(place: Place) -> list[Any]:
    """Values of another kind than the declared one."""
    return [*INVALID[type(value_at(place))], *([1.5] if is_whole(place) else [])]


@st.composite
def of_another_kind(draw: st.DrawFn) -> tuple[str, str]:
    """The last key of a place, and a configuration with a value of another kind there."""
    place = draw(st.sampled_from(KEYS))
    value = draw(st.sampled_from(wrong_at(place)))
    return place[-1], over(place, value)


def misspelt(draw: st.DrawFn, word: str) -> str:
    """Misspelling: a letter left out, doubled, exchanged with the next or in capitals, or another word."""
    at = draw(st.integers(0, len(word) - 2))
    change = draw(st.sampled_from(["out", "double", "swap", "upper", "more"]))
    changed = {
        "out": word[:at] + word[at + 1 :],
        "double": word[: at + 1] + word[at:],
        "swap": word[:at] + word[at + 1] + word[at] + word[at + 2 :],
        "upper": word.upper(),
        "more": f"{word}s_",
    }[change]
    return changed if changed != word else f"{word}_"


DECLARED = [
    place for place in KEYS if place[-2:-1] not in (("heart",), ("prior",), ("settings",), ("noise",))
]
"""Keys of tables whose keys are declared, and are not names of parameters or settings."""


@st.composite
def of_another_name(draw: st.DrawFn) -> tuple[str, str]:
    """A misspelt key, and a configuration with it."""
    place = draw(st.sampled_from([keys for keys in DECLARED if len(keys[-1]) > 2]))
    key = misspelt(draw, place[-1])
    return key, over((*place[:-1], key), value_at(place))


@st.composite
def spoilt_table(draw: st.DrawFn, text: str, separator: str, first: int, empty: bool) -> str:
    """A table with a word in the place of a number, or a row with a cell more or less; rows from `first` on.

    empty: whether an empty cell is wrong too.
    """
    lines = text.splitlines()
    row = draw(st.integers(first, len(lines) - 1))
    cells = lines[row].split(separator)
    numbers = [column for column, cell in enumerate(cells) if re.fullmatch(r"[\d.]+", cell)]
    change = draw(st.sampled_from(["word", "word", "word", "more", "less"]))
    column = draw(st.sampled_from(numbers))
    if change == "word":
        cells[column] = draw(st.sampled_from(WORDS if empty or column == 0 else WORDS[1:]))
    elif change == "more":
        cells.insert(column, "1")
    else:
        del cells[column]
    lines[row] = separator.join(cells)
    return "\n".join(lines) + "\n"


TABLES_OF_CASES = spoilt_table(CASES, "\t", 1, empty=True)
RECORDINGS = spoilt_table(recording(), ",", 2, empty=False)
