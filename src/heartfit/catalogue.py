"""Everything that is declared, from the declarations: the parameters of hearts and mechanisms."""

from collections.abc import Iterator
from typing import Any

from heartfit.heart import FOURTEEN, Heart
from heartfit.mechanism import registered
from heartfit.parameter import Parameter, parameters_of

HEADER = """# Parameters

Every parameter of the standard heart and of the mechanisms that can be added to it. This page is written by
`heartfit parameters` from the declarations in the code. "sd" is the relative standard deviation of the prior;
the paper's fourteen are marked with *; "off" is the value at which a mechanism vanishes.

| name | symbol | value | unit | sd | off | meaning | declared in |
|---|---|---|---|---|---|---|---|
"""


def declared(name: str) -> Parameter:
    """The declaration of a parameter by a name as Heart.with_parameters takes; raises KeyError as it does."""
    *parts, last = Heart().path_of(name).split(".")
    part: Any = Heart()
    for step in parts:
        part = getattr(part, step, None) or _mechanism(step)
    return next(entry for entry in parameters_of(part) if entry.name == last)


def _mechanism(name: str) -> Any:
    return next(each for each in Heart().mechanisms if type(each).__name__ == name)


def parameter_page() -> str:
    """The reference page of all parameters, in Markdown."""
    return HEADER + "".join(_row(path, entry) for path, entry in _all_parameters())


def _all_parameters() -> Iterator[tuple[str, Parameter]]:
    standard = Heart()
    for path in standard.parameters():
        yield path, declared(path)
    present = {type(each) for each in standard.mechanisms}
    for name, kind in registered().items():
        if kind not in present:
            yield from ((f"{name}.{entry.name}", entry) for entry in parameters_of(kind))


def _row(path: str, entry: Parameter) -> str:
    of_the_paper = entry.name in FOURTEEN and "pulmonary_tree" not in path
    cells = (
        f"{entry.name}{' *' if of_the_paper else ''}",
        f"${entry.symbol}$",
        f"{entry.value:g}",
        entry.unit,
        "" if entry.sd is None else f"{100 * entry.sd:g} %",
        "" if entry.off is None else f"{entry.off:g}",
        entry.meaning,
        f"`{path}`",
    )
    return f"| {' | '.join(cells)} |\n"
