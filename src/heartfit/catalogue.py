"""Everything that is declared, from the declarations: the parameters of hearts and mechanisms."""

from collections.abc import Iterable, Iterator
from difflib import get_close_matches
from functools import cache
from typing import Any

from heartfit.heart import FOURTEEN, Heart
from heartfit.mechanism import Mechanism, registered
from heartfit.parameter import Parameter, parameters_of

HEADER = """# Parameters

Every parameter of the standard heart and of the mechanisms that can be added to it. This page is written by
`heartfit parameters` from the declarations in the code. "sd" is the relative standard deviation of the prior;
the paper's fourteen are marked with *; "off" is the value at which a mechanism vanishes, "scale" the standard
deviation, in the unit, that a search for causes gives it about that value: ± where it may have either sign. A scale
without an off value is that of a parameter of a mechanism about its own value.

| name | symbol | value | unit | sd | off | scale | meaning | declared in |
|---|---|---|---|---|---|---|---|---|
"""


def declared(name: str) -> Parameter:
    """The declaration of a parameter by a name as Heart.with_parameters takes; raises KeyError as it does."""
    return _declared(name, tuple(registered().values()))


@cache
def _declared(name: str, known: tuple[type[Mechanism], ...]) -> Parameter:
    """Kept for a state of the registry: the jobs of a study ask for the same few names over and over."""
    heart = composed(kind.__name__ for kind in known)
    *parts, last = heart.path_of(name).split(".")
    part: Any = heart
    for step in parts:
        part = getattr(part, step, None) or _mechanism(heart, step)
    return next(entry for entry in parameters_of(part) if entry.name == last)


def _mechanism(heart: Heart, name: str) -> Any:
    return next(each for each in heart.mechanisms if type(each).__name__ == name)


def composed(mechanisms: Iterable[str], heart: Heart | None = None) -> Heart:
    """A heart (the standard one) plus mechanisms by name; raises KeyError naming the nearest known one."""
    known, result = registered(), heart or Heart()
    for name in mechanisms:
        if name not in known:
            near = get_close_matches(name, known, n=1, cutoff=0.0)[0]
            raise KeyError(
                f"mechanism {name!r} is unknown; did you mean {near}? Known are {', '.join(known)}"
            )
        result = result + known[name]()
    return result


def parameter_page() -> str:
    """The reference page of all parameters, in Markdown."""
    return HEADER + "".join(_row(path, entry) for path, entry in _all_parameters())


def _all_parameters() -> Iterator[tuple[str, Parameter]]:
    yield from ((path, declared(path)) for path in composed(registered()).parameters())


def _row(path: str, entry: Parameter) -> str:
    of_the_paper = entry.name in FOURTEEN and "pulmonary_tree" not in path
    cells = (
        f"{entry.name}{' *' if of_the_paper else ''}",
        f"${entry.symbol}$",
        f"{entry.value:g}",
        entry.unit,
        "" if entry.sd is None else f"{100 * entry.sd:g} %",
        "" if entry.off is None else f"{entry.off:g}",
        "" if entry.scale is None else f"{'' if entry.one_sided else '±'}{entry.scale:g}",
        entry.meaning,
        f"`{path}`",
    )
    return f"| {' | '.join(cells)} |\n"
