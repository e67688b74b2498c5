"""Sides of the heart: their compartments and valves, what acts in them, and the blood that a beat moves."""

from collections.abc import Mapping, Sequence

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.roles.interfaces import COMPARTMENTS, Amendment, Dynamics, Flow, Mechanism, Narrowing

VALVES = {
    "mitral": ("left_atrium", "lv"),
    "aortic": ("lv", "aorta"),
    "tricuspid": ("right_atrium", "rv"),
    "pulmonary": ("rv", "pulmonary_artery"),
}


def acts_within(kind: type[Mechanism], sides: int) -> bool:
    """True if a kind of mechanism acts in a heart of so many sides: with one, nothing of the right heart does."""
    if issubclass(kind, Flow):
        return compartments_of(sides) >= {kind.upstream, kind.downstream}
    if issubclass(kind, (Narrowing, Dynamics)):
        return compartments_of(sides) >= {*VALVES[kind.valve]}
    return sides == 2 or not changes_right_wall(kind)


def require_within(mechanism: Mechanism, sides: int) -> None:
    """Raise InputError for a mechanism that does not act in a heart of so many sides."""
    if not acts_within(type(mechanism), sides):
        raise InputError(
            f"{type(mechanism).__name__} acts on the right heart, and this one has a left ventricle only: use "
            "adult(both_ventricles=True)"
        )


def changes_right_wall(kind: type[Mechanism]) -> bool:
    """True if a kind of mechanism changes a constant of the right free wall."""
    return issubclass(kind, Amendment) and kind.amends.startswith("right.")


def net_inflow(flows: Mapping[str, Floats], mechanisms: Sequence[Mechanism]) -> dict[str, float]:
    """Mean flow [m^3/s] into every compartment through valves and leaks, by name.

    flows: of the branches (t,) [m^3/s] at equidistant times of a period, whose ends agree.
    """
    leaks = {type(m).__name__: (m.upstream, m.downstream) for m in mechanisms if isinstance(m, Flow)}
    inflow = dict.fromkeys(COMPARTMENTS, 0.0)
    for name, flow in flows.items():
        upstream, downstream = (VALVES | leaks)[name]
        mean = float(np.mean(flow[1:]))
        inflow[upstream] -= mean
        inflow[downstream] += mean
    return inflow


def right_excess(flows: Mapping[str, Floats], mechanisms: Sequence[Mechanism]) -> float:
    """Mean flow [m^3/s] that the right side pumps into the lung beyond what the left atrium loses."""
    inflow = net_inflow(flows, mechanisms)
    return inflow["pulmonary_artery"] + inflow["left_atrium"]


def compartments_of(sides: int) -> set[str]:
    """Compartments of the left heart, or of both sides."""
    return {name for i, name in enumerate(COMPARTMENTS) if i % 2 < sides}
