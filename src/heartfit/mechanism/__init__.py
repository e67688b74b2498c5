"""Mechanisms: physical effects that are added to a heart, each in the role that fixes where it enters.

A mechanism is one frozen dataclass in one file of ``heartfit/mechanisms``; it declares its parameters
(:mod:`heartfit.parameter`), exactly one of which has an ``off`` value at which the effect vanishes. The folder
is the registry: a file dropped there is a candidate everywhere.
"""

from heartfit.mechanism.base import Mechanism
from heartfit.mechanism.blood import COMPARTMENTS, External, Flow, Narrowing, Pressure
from heartfit.mechanism.instrument import Sensor
from heartfit.mechanism.muscle import Amendment, Availability, Delay, Relaxation, Stress
from heartfit.mechanism.registry import ROLES, mechanism, registered

__all__ = [
    "COMPARTMENTS",
    "ROLES",
    "Amendment",
    "Availability",
    "Delay",
    "External",
    "Flow",
    "Mechanism",
    "Narrowing",
    "Pressure",
    "Relaxation",
    "Sensor",
    "Stress",
    "mechanism",
    "registered",
]
