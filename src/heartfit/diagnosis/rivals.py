"""Explanations of one recording that compete by their evidence."""

from collections.abc import Mapping
from dataclasses import dataclass

from heartfit.diagnosis.cause import Gain
from heartfit.observation.curve import Curve


@dataclass(frozen=True, eq=False)
class Rival:
    """An explanation after its refit, the curves of its beat, and its gains over none on what no fit has seen.

    log_evidence: up to a constant of the samples; misfit: r^T R^-1 r of so many samples; parameters: SI, by name.
    """

    name: str
    log_evidence: float
    misfit: float
    samples: int
    simulations: int
    parameters: Mapping[str, float]
    curves: Mapping[str, Curve]
    gains: tuple[Gain, ...] = ()
