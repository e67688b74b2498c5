"""Tables that take the keys they declare and no other, and errors that fit on a line."""

from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ConfigDict, ValidationError

from heartfit.errors import InputErrors


class Strict(BaseModel):
    """A frozen table; an unknown key is an error."""

    model_config = ConfigDict(extra="forbid", frozen=True)


T = TypeVar("T", bound=Strict)


def validated(kind: type[T], content: Mapping[str, Any], where: str) -> T:
    """`content` as `kind`; raises InputErrors, a line each: where, what, what was expected, what to do."""
    try:
        return kind.model_validate(content)
    except ValidationError as error:
        raise InputErrors(f"{where}: {_line(kind, dict(each))}" for each in error.errors()) from None


def _line(kind: type[Strict], error: dict[str, Any]) -> str:
    place = ".".join(map(str, error["loc"]))
    if error["type"] == "extra_forbidden":
        return f"unknown key {place}; {_nearest(kind, error['loc'])}"
    if error["type"] == "missing":
        return f"{place} is missing; add it"
    problem = error["msg"].removeprefix("Value error, ")
    if not place or error["type"] == "value_error":
        return f"{place}: {problem}".removeprefix(": ")
    return f"{place} = {error['input']!r}: {problem[0].lower()}{problem[1:]}; correct it"


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
