"""The composition root: a heart is its slots (tissue, circulation) plus any number of mechanisms."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace
from difflib import get_close_matches
from functools import cached_property, reduce
from typing import Any

from heartfit.core.errors import InputError
from heartfit.core.parameter import parameter_values
from heartfit.core.periodic import BEATS
from heartfit.heart.circulation.network import Circulation
from heartfit.heart.muscle.tissue import Tissue
from heartfit.mechanisms.atrial_kick import AtrialKick
from heartfit.roles import Mechanism, Sensor, registered

PAPER_PARAMETERS = (
    "sigma_0", "k_RS", "k_ATP", "k_0", "alpha", "mu", "E_s", "K", "c_1", "c_2", "R_p", "tau", "Z_c", "L",
)  # fmt: skip
"""Names of the fourteen parameters of Marchesseau et al., MICCAI 2012."""


@dataclass(frozen=True, repr=False)
class Heart:
    """Slots (tissue, circulation), mechanisms and the period of the beat [s].

    ``heart + mechanism`` is a new heart with that mechanism added; it replaces one of the same name. Raises InputError
    for a period that no human heart has, and TypeError for a mechanism that is no instance of one.
    """

    tissue: Tissue = field(default_factory=Tissue)
    circulation: Circulation = field(default_factory=Circulation)
    mechanisms: tuple[Mechanism, ...] = (AtrialKick(),)
    period: float = 0.829

    def __post_init__(self) -> None:
        if not BEATS[0] <= self.period <= BEATS[1]:
            raise InputError(
                f"heart: period = {self.period:g} s; expected {BEATS[0]:g} to {BEATS[1]:g} s: convert it to seconds"
            )
        for mechanism in self.mechanisms:
            _require_instance(mechanism)

    def __add__(self, mechanism: Mechanism) -> "Heart":
        name = type(mechanism).__name__
        kept = tuple(present for present in self.mechanisms if type(present).__name__ != name)
        return replace(self, mechanisms=(*kept, mechanism))

    def __repr__(self) -> str:
        slots = f"{type(self.tissue.passive).__name__}, {type(self.tissue.active).__name__}"
        return f"Heart({self.period:g} s, {slots}; {', '.join(map(repr, self.mechanisms)) or 'no mechanism'})"

    @property
    def trigger(self) -> float:
        """Simulated time of the ECG trigger [s]."""
        return self.tissue.control.onset + self.tissue.control.trigger_delay

    @property
    def muscle(self) -> Tissue:
        """Tissue of the ventricles: the tissue slot as amended by the mechanisms."""
        return self.tissue.with_mechanisms(self.mechanisms, self.period)

    @property
    def sensors(self) -> tuple[Sensor, ...]:
        """Mechanisms that distort the measurements, in the order in which they act."""
        return tuple(m for m in self.mechanisms if isinstance(m, Sensor))

    def parameters(self) -> dict[str, float]:
        """Values of all parameters by dotted path; :meth:`with_parameters` explains short names."""
        return dict(self._parameters)

    @cached_property
    def _parameters(self) -> dict[str, float]:
        """The parameters; a search amends one heart thousands of times."""
        return dict(_list_parameters(self))

    def with_parameters(self, values: Mapping[str, float]) -> "Heart":
        """Copy of the heart with the parameters ``values`` replaced.

        A name is a dotted path ("circulation.pulmonary_tree.R_p") or its last part, provided that this is unique
        or one of the paper's fourteen (R_p, tau, Z_c and L then mean the systemic circulation). A parameter of the
        right wall gives way to another of its name. Raises ``KeyError`` for an unknown or ambiguous name; the message
        lists the nearest names or the candidate paths.
        """
        known = self._parameters
        changes: dict[str, Any] = {}
        for name, value in values.items():
            path = _resolve_path(name, known)
            if known[path] == value:
                continue
            *parts, last = path.split(".")
            reduce(lambda branch, part: branch.setdefault(part, {}), parts, changes)[last] = float(value)
        return _with_changes(self, changes)

    def parameter_path(self, name: str) -> str:
        """Dotted path of the parameter ``name``; raises ``KeyError`` as :meth:`with_parameters` does."""
        return _resolve_path(name, self._parameters)


def _resolve_path(name: str, parameters: Mapping[str, float]) -> str:
    if name in parameters:
        return name
    paths = [path for path in parameters if path.endswith(f".{name}")]
    systemic = [path for path in paths if path.startswith("circulation.systemic.")]
    if len(paths) > 1 and name in PAPER_PARAMETERS and systemic:
        paths = systemic
    if len(paths) > 1:
        paths = [path for path in paths if not path.startswith("tissue.right.")]
    if len(paths) == 1:
        return paths[0]
    problem = f"is one of {paths}: give the path" if paths else _unknown(name, parameters)
    raise KeyError(f"parameter {name!r} {problem}")


def _unknown(name: str, parameters: Mapping[str, float]) -> str:
    kind = name.split(".")[0]
    own = [path for path in parameters if path.startswith(f"{kind}.")]
    if own:
        return f"is unknown; {kind} has {', '.join(own)}"
    if kind in registered():
        return f"is one of a mechanism that the heart lacks: add it, heart + {kind}()"
    near = get_close_matches(name, [path.rsplit(".", 1)[-1] for path in parameters] + list(parameters))
    return f"is unknown, nearest are {near}" if near else "is unknown; heart.parameters() lists all"


def _require_instance(mechanism: object) -> None:
    """Raise TypeError unless this is an instance of a mechanism."""
    if isinstance(mechanism, Mechanism):
        return
    text, name = (
        (f"class {mechanism.__name__}", mechanism.__name__)
        if isinstance(mechanism, type)
        else (repr(mechanism), str(mechanism))
    )
    example = name if name in registered() else "MitralRegurgitation"
    raise TypeError(f"heart: {text} is no mechanism; expected an instance: create one, such as {example}()")


def _list_parameters(part: Any, prefix: str = "") -> list[tuple[str, float]]:
    parameters = [(f"{prefix}{name}", value) for name, value in parameter_values(part)]
    for entry in fields(part):
        value = getattr(part, entry.name)
        if is_dataclass(value):
            parameters += _list_parameters(value, f"{prefix}{entry.name}.")
        elif isinstance(value, tuple):
            for member in value:
                parameters += _list_parameters(member, f"{prefix}{type(member).__name__}.")
    return parameters


def _with_changes(part: Any, changes: Mapping[str, Any]) -> Any:
    """Copy of ``part`` with new values, or nested changes, by name; other names are classes of its mechanisms."""
    own: dict[str, Any] = {}
    kinds: dict[str, Any] = {}
    for name, change in changes.items():
        if hasattr(part, name):
            own[name] = _with_changes(getattr(part, name), change) if isinstance(change, dict) else change
        else:
            kinds[name] = change
    if kinds:
        own["mechanisms"] = tuple(
            _with_changes(mechanism, kinds.get(type(mechanism).__name__, {})) for mechanism in part.mechanisms
        )
    return replace(part, **own)
