"""Roles of mechanisms, the physical effects that are added to a heart.

A mechanism is one frozen dataclass in one file of ``heartfit/mechanisms``; it declares its parameters
(:mod:`heartfit.core.parameter`), exactly one of which has an ``off`` value at which the effect vanishes. The folder
is the registry: a file dropped there is a candidate everywhere.
"""

from heartfit.roles.elastic_atrium import ElasticAtrium
from heartfit.roles.interfaces import (
    COMPARTMENTS,
    Amendment,
    Attachment,
    Availability,
    Chamber,
    Contraction,
    Delay,
    Dynamics,
    External,
    Flow,
    Mechanism,
    Narrowing,
    Pressure,
    Relaxation,
    Sensor,
    Stress,
)
from heartfit.roles.registry import ROLES, mechanism, registered, require_registered
from heartfit.roles.regurgitation import Regurgitation
from heartfit.roles.stenosis import Stenosis
from heartfit.roles.valve_dynamics import ValveDynamics

__all__ = [
    "COMPARTMENTS",
    "ROLES",
    "Amendment",
    "Attachment",
    "Availability",
    "Chamber",
    "Contraction",
    "Delay",
    "Dynamics",
    "ElasticAtrium",
    "External",
    "Flow",
    "Mechanism",
    "Narrowing",
    "Pressure",
    "Regurgitation",
    "Relaxation",
    "Sensor",
    "Stenosis",
    "Stress",
    "ValveDynamics",
    "mechanism",
    "registered",
    "require_registered",
]
