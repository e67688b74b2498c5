"""The composition root: a heart is its slots plus any number of mechanisms."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace
from difflib import get_close_matches
from functools import reduce
from typing import Any

from heartfit.circulation.network import Circulation
from heartfit.mechanics.tissue import Tissue
from heartfit.mechanism import Mechanism, Sensor
from heartfit.mechanisms.atrial_kick import AtrialKick
from heartfit.parameter import values_of

FOURTEEN = (
    "sigma_0", "k_RS", "k_ATP", "k_0", "alpha", "mu", "E_s", "K", "c_1", "c_2", "R_p", "tau", "Z_c", "L",
)  # fmt: skip
"""The parameters of the paper, by name."""


@dataclass(frozen=True)
class Heart:
    """Slots (tissue, circulation), mechanisms and the period of the beat, s.

    ``heart + mechanism`` is a new heart with one mechanism more; one of the same kind is replaced.
    """

    tissue: Tissue = field(default_factory=Tissue)
    circulation: Circulation = field(default_factory=Circulation)
    mechanisms: tuple[Mechanism, ...] = (AtrialKick(),)
    period: float = 0.829

    def __add__(self, added: Mechanism) -> "Heart":
        kept = tuple(m for m in self.mechanisms if type(m) is not type(added))
        return replace(self, mechanisms=(*kept, added))

    @property
    def trigger(self) -> float:
        """Simulated time of the ECG trigger, s."""
        return self.tissue.control.onset + self.tissue.control.trigger_delay

    @property
    def muscle(self) -> Tissue:
        """The tissue with what the mechanisms make of it: what the ventricles are made of."""
        return self.tissue.under(self.mechanisms, self.period)

    @property
    def sensors(self) -> tuple[Sensor, ...]:
        """The mechanisms that distort what is measured of the heart, in the order in which they act."""
        return tuple(m for m in self.mechanisms if isinstance(m, Sensor))

    def parameters(self) -> dict[str, float]:
        """All parameters by dotted path below the heart; see :meth:`with_parameters` for short names."""
        return dict(_walk(self))

    def with_parameters(self, values: Mapping[str, float]) -> "Heart":
        """A heart in which some parameters have other values.

        A name is a dotted path ("circulation.pulmonary_tree.R_p") or its end, where that is unique or one of
        the paper's fourteen (R_p, tau, Z_c and L then mean the systemic circulation). Raises ``KeyError``
        for an unknown or ambiguous name, naming the nearest known ones.
        """
        known = self.parameters()
        changes: dict[str, Any] = {}
        for name, value in values.items():
            *parts, last = _path_of(name, known).split(".")
            reduce(lambda branch, part: branch.setdefault(part, {}), parts, changes)[last] = float(value)
        return _changed(self, changes)

    def path_of(self, name: str) -> str:
        """Dotted path of the parameter ``name``."""
        return _path_of(name, self.parameters())


def _path_of(name: str, known: Mapping[str, float]) -> str:
    if name in known:
        return name
    paths = [path for path in known if path.endswith(f".{name}")]
    systemic = [path for path in paths if path.startswith("circulation.systemic.")]
    if len(paths) > 1 and name in FOURTEEN and systemic:
        paths = systemic
    if len(paths) == 1:
        return paths[0]
    near = get_close_matches(name, [path.rsplit(".", 1)[-1] for path in known] + list(known))
    problem = f"is one of {paths}: give the path" if paths else f"is unknown, nearest are {near}"
    raise KeyError(f"parameter {name!r} {problem}")


def _walk(part: Any, prefix: str = "") -> list[tuple[str, float]]:
    found = [(f"{prefix}{name}", value) for name, value in values_of(part)]
    for entry in fields(part):
        value = getattr(part, entry.name)
        if is_dataclass(value):
            found += _walk(value, f"{prefix}{entry.name}.")
        elif isinstance(value, tuple):
            for member in value:
                found += _walk(member, f"{prefix}{type(member).__name__}.")
    return found


def _changed(part: Any, changes: Mapping[str, Any]) -> Any:
    """The part with other values, or changes of parts, by name; names that it has not are those of its mechanisms."""
    own = {name: change for name, change in changes.items() if hasattr(part, name)}
    new = {
        name: _changed(getattr(part, name), change) if isinstance(change, dict) else change
        for name, change in own.items()
    }
    if len(own) < len(changes):
        kinds = {name: change for name, change in changes.items() if name not in own}
        new["mechanisms"] = tuple(
            _changed(each, kinds.get(type(each).__name__, {})) for each in part.mechanisms
        )
    return replace(part, **new)
