"""Validation of the configuration: strict tables and types, and one-line errors that name key and correction."""

import re
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from reprlib import Repr
from typing import Annotated, Any, Literal, TypeVar, get_args

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    ValidationError,
    ValidationInfo,
    field_validator,
)

from heartfit.core.errors import InputErrors

ABBREVIATE = Repr()
ABBREVIATE.maxstring = ABBREVIATE.maxother = 60

UNDERSCORED_NUMBER = re.compile(r"\s*[+-]?[\d.]+_[\d_.]*(e[+-]?\d+)?\s*", re.IGNORECASE)
"""A number with an underscore between its digits."""


class Strict(BaseModel):
    """A frozen table of finite numbers; unknown keys, booleans for numbers and underscored numbers are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    @field_validator("*", mode="before")
    @classmethod
    def _reject_booleans(cls, value: Any, field: ValidationInfo) -> Any:
        """Raise ValueError for a boolean: YAML reads yes, no, on, off as booleans, and pydantic these as 1 and 0."""
        wanted = cls.model_fields[field.field_name or ""].annotation
        if _table_in(wanted) is None and not _holds(wanted, bool):
            for key, entry in _entries(value):
                if isinstance(entry, bool):
                    raise ValueError(f"{key}{entry} says yes or no; expected a number or a text: correct it")
        return value

    @field_validator("*", mode="before")
    @classmethod
    def _reject_underscored_numbers(cls, value: Any, field: ValidationInfo) -> Any:
        """Raise ValueError for a text such as 1_0, which pydantic reads as ten."""
        wanted = cls.model_fields[field.field_name or ""].annotation
        if _holds(wanted, int) or _holds(wanted, float):
            for key, entry in _entries(value):
                if isinstance(entry, str) and UNDERSCORED_NUMBER.fullmatch(entry):
                    raise ValueError(f"{key}{_abbreviated(entry)} is no number; expected digits: correct it")
        return value


T = TypeVar("T", bound=Strict)


def validate(kind: type[T], content: Mapping[str, Any], where: str) -> T:
    """Return `content` as a table of `kind`.

    Raises InputErrors with one line per mistake: its place, the value, the expected value, the correction.
    """
    try:
        return kind.model_validate(content)
    except ValidationError as error:
        raise InputErrors(
            f"{where}: {_problem_line(kind, dict(detail))}" for detail in error.errors()
        ) from None


def _problem_line(kind: type[Strict], error: dict[str, Any]) -> str:
    place = ".".join(_abbreviated(str(key)) for key in error["loc"])
    if error["type"] == "extra_forbidden":
        return f"unknown key {place}; {_nearest_keys(kind, error['loc'])}"
    if error["type"] == "missing":
        return f"{place} is missing; add it"
    if error["type"] == "invalid_key":
        return f"key {place} is no text; expected a name: correct it"
    problem = error["msg"].removeprefix("Value error, ")
    if not place or error["type"] == "value_error":
        return f"{place}: {problem}".removeprefix(": ")
    return f"{place} = {ABBREVIATE.repr(error['input'])}: {problem[0].lower()}{problem[1:]}; correct it"


def _abbreviated(key: str) -> str:
    return key if len(key) <= ABBREVIATE.maxstring else f"{key[: ABBREVIATE.maxstring]}..."


def _entries(value: Any) -> Iterator[tuple[str, Any]]:
    """Yield the entries of a mapping or list, or the value itself, after their key and a colon or an empty text."""
    if isinstance(value, Mapping):
        yield from ((f"{_abbreviated(str(key))}: ", entry) for key, entry in value.items())
    else:
        yield from (("", entry) for entry in (value if isinstance(value, list | tuple) else [value]))


def _holds(annotation: Any, kind: type) -> bool:
    return annotation is kind or any(_holds(argument, kind) for argument in get_args(annotation))


def _nearest_keys(kind: type[Strict], place: tuple[Any, ...]) -> str:
    """Return the likeliest intended key and all keys of the table that holds the unknown key."""
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
    """Return the table type in an annotation such as dict[str, Setting] or MeshSize | None, or None."""
    if isinstance(annotation, type) and not get_args(annotation) and issubclass(annotation, Strict):
        return annotation
    return next(filter(None, map(_table_in, get_args(annotation))), None)


LARGEST_COUNT = 10_000

Count = Annotated[int, Field(ge=1, le=LARGEST_COUNT)]
"""Number of jobs, hearts or steps; a larger one is a mistake that would never end."""

Seed = Annotated[int, Field(ge=0, lt=1 << 63)]

PATH_STEP = re.compile(r"[^\W_][\w.-]*")


def _require_relative_folder(path: str) -> str:
    """Raise ValueError for an absolute path, .., a hidden folder or a wildcard; results are written into the path."""
    if not all(map(PATH_STEP.fullmatch, path.split("/"))):
        raise ValueError(
            f"{path!r} is not within the working directory by plain names, and is written into; give a folder such as "
            "results/mine, of letters, digits and . _ -"
        )
    return path


RelativeFolder = Annotated[str, AfterValidator(_require_relative_folder)]

FigureFormat = Literal["png", "pdf"]


def _require_png(formats: tuple[FigureFormat, ...]) -> tuple[FigureFormat, ...]:
    """Return the formats, PNG first; raise ValueError without it or for a format stated twice."""
    if "png" not in formats or len(set(formats)) < len(formats):
        raise ValueError(
            f"{list(formats)}; expected png, which the report shows, and pdf on request: state [png] or [png, pdf]"
        )
    return ("png", *(entry for entry in formats if entry != "png"))


FigureFormats = Annotated[tuple[FigureFormat, ...], AfterValidator(_require_png)]
"""File formats of the figures, PNG first."""

RESULT_FOLDERS = (
    *("benchmarks", "cohort", "curves", "discovery", "discovery_benchmark", "figures", "geometry", "images"),
    *("logs", "registration", "registration_error", "sensitivity", "tables", "templates"),
)
"""Folders of the results; the results of a case or setting of such a name would be written into one of them."""

NAME_PATTERN = re.compile(r"[A-Za-z][A-Za-z0-9_-]{0,39}")


def _require_name(name: str) -> str:
    """Raise ValueError unless ``name`` can name a folder and stand in patterns of paths."""
    if not NAME_PATTERN.fullmatch(name):
        raise ValueError(
            f"{name[:60]!r} is no name; expected a letter, then at most 39 letters, digits, _ and -: rename it"
        )
    if name in RESULT_FOLDERS:
        raise ValueError(f"{name!r} is the name of a folder of the results; rename it")
    return name


Name = Annotated[str, AfterValidator(_require_name)]
