"""Tables that take the keys they declare and no other, and errors that fit on a line."""

import re
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from reprlib import Repr
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ConfigDict, ValidationError, ValidationInfo, field_validator

from heartfit.errors import InputErrors

SHORT = Repr()
SHORT.maxstring = SHORT.maxother = 60

APART = re.compile(r"\s*[+-]?[\d.]+_[\d_.]*(e[+-]?\d+)?\s*", re.IGNORECASE)
"""A number whose digits an underscore keeps apart."""


class Strict(BaseModel):
    """A frozen table of finite numbers; unknown keys are errors, and so is what only a program takes for a number."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    @field_validator("*", mode="before")
    @classmethod
    def _a_truth_is_no_number(cls, value: Any, field: ValidationInfo) -> Any:
        """YAML takes yes, no, on and off for truths, and pydantic these for 1 and 0."""
        wanted = cls.model_fields[field.field_name or ""].annotation
        if _table_in(wanted) is None and not _holds(wanted, bool):
            for key, each in _entries(value):
                if isinstance(each, bool):
                    raise ValueError(f"{key}{each} says yes or no; expected a number or a text: correct it")
        return value

    @field_validator("*", mode="before")
    @classmethod
    def _digits_stand_together(cls, value: Any, field: ValidationInfo) -> Any:
        """Pydantic reads 1_0 as ten."""
        wanted = cls.model_fields[field.field_name or ""].annotation
        if _holds(wanted, int) or _holds(wanted, float):
            for key, each in _entries(value):
                if isinstance(each, str) and APART.fullmatch(each):
                    raise ValueError(f"{key}{_short(each)} is no number; expected digits: correct it")
        return value


T = TypeVar("T", bound=Strict)


def validated(kind: type[T], content: Mapping[str, Any], where: str) -> T:
    """`content` as `kind`; raises InputErrors, a line each: where, what, what was expected, what to do."""
    try:
        return kind.model_validate(content)
    except ValidationError as error:
        raise InputErrors(f"{where}: {_line(kind, dict(each))}" for each in error.errors()) from None


def _line(kind: type[Strict], error: dict[str, Any]) -> str:
    place = ".".join(_short(str(key)) for key in error["loc"])
    if error["type"] == "extra_forbidden":
        return f"unknown key {place}; {_nearest(kind, error['loc'])}"
    if error["type"] == "missing":
        return f"{place} is missing; add it"
    if error["type"] == "invalid_key":
        return f"key {place} is no text; expected a name: correct it"
    problem = error["msg"].removeprefix("Value error, ")
    if not place or error["type"] == "value_error":
        return f"{place}: {problem}".removeprefix(": ")
    return f"{place} = {SHORT.repr(error['input'])}: {problem[0].lower()}{problem[1:]}; correct it"


def _short(key: str) -> str:
    return key if len(key) <= SHORT.maxstring else f"{key[: SHORT.maxstring]}..."


def _entries(value: Any) -> Iterator[tuple[str, Any]]:
    """What a value is or holds, and the key of each that has one, with a colon."""
    if isinstance(value, Mapping):
        yield from ((f"{_short(str(key))}: ", each) for key, each in value.items())
    else:
        yield from (("", each) for each in (value if isinstance(value, list | tuple) else [value]))


def _holds(annotation: Any, kind: type) -> bool:
    return annotation is kind or any(_holds(each, kind) for each in get_args(annotation))


def _nearest(kind: type[Strict], place: tuple[Any, ...]) -> str:
    """What the unknown key may have meant, among the keys of the table it stands in."""
    table = _table_at(kind, place[:-1])
    keys = list(table.model_fields) if table else []
    near = get_close_matches(str(place[-1]), keys, n=1, cutoff=0.4)
    meant = f"did you mean {near[0]}? " if near else ""
    return f"{meant}Known are {', '.join(keys)}"


def _table_at(kind: type[Strict], place: tuple[Any, ...]) -> type[Strict] | None:
    table: type[Strict] | None = kind
    for key in place:
        if table is not None and key in table.model_fields:
            table = _table_in(table.model_fields[key].annotation)
    return table


def _table_in(annotation: Any) -> type[Strict] | None:
    """The table that an annotation such as dict[str, Setting] or MeshSize | None holds."""
    if isinstance(annotation, type) and not get_args(annotation) and issubclass(annotation, Strict):
        return annotation
    return next(filter(None, map(_table_in, get_args(annotation))), None)
