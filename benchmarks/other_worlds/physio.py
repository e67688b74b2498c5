"""Spherical left ventricle of the package physioblocks (LGPL-3.0, Inria) between an atrium and a Windkessel.

Caruel M et al. 2014, doi 10.1007/s10237-013-0544-6: a thick sphere of a hyperelastic material and of the sarcomeres of
Bestel, Clement and Sorine, whose stiffness and tension are states; resistances with inertia for valves. The loop is
open: the pressures of the atrium and of the veins are given. Filling multiplies those of the atrium, and a leaking
mitral valve does not raise them. The published open valves hardly resist, so that a stenosis adds a resistance; as an
atrium at its given pressure would not fill the ventricle through it, a mitral one also raises that pressure by what an
adult's inflow loses there.
"""

import logging
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import physioblocks.library
from physioblocks.configuration import Configuration, load
from physioblocks.io.configuration import read_json
from physioblocks.utils.dynamic_import_utils import import_libraries

from benchmarks.other_worlds.adult import Adult, Beat

logging.disable(logging.CRITICAL)
PACKAGE = Path(physioblocks.library.__file__).parents[1]
REFERENCE = PACKAGE / "references" / "full_configurations" / "spherical_heart_forward_sim.jsonc"
SKIPPED = ("plots", "preprocesses", "postprocesses")
"""Parts of the reference that do not change the simulation."""
import_libraries([PACKAGE / "library"])
BEATS, STEP = 12, 1e-3
"""Number of beats until the last is kept, and the step of the reference [s]."""
INITIAL = 300.0
"""Pressure [Pa] of the ventricle at rest from which the package starts, low enough for soft ones."""
MILLILITRE, MMHG = 1e-6, 133.322
STENOSIS = {"mitral": 0.5e6, "aortic": 1e6}
"""Resistance [Pa s/m3] that a stenosis adds for each unit of its factor above 1."""
INFLOW = 150e-6
"""Inflow [m3/s] of an adult of the reference's size, which the atrium's pressure keeps up in a stenosis."""
LEAK = {"mitral": 1.6e-8, "aortic": 1.7e-8}
"""Conductance [m3/(s Pa)] of a leak of half of the stroke volume."""


def simulate(adult: Adult) -> Beat:
    """Simulate the last of several beats."""
    reference = read_json(str(REFERENCE))
    configuration = {name: part for name, part in reference.items() if name not in SKIPPED}
    own, size = configuration["parameters"], adult.size
    own["time.duration"] = BEATS * adult.period
    own["heart_rate"] = 60.0 / adult.period
    own["cavity.blood_pressure.init"] = INITIAL
    for name in ("heart_radius", "heart_thickness"):
        own[name] *= size ** (1.0 / 3.0)
    own["heart_contractility"] *= adult.contractility
    first, first_power, second, second_power = own["cavity.dynamics.hyperelastic_cst"]
    own["cavity.dynamics.hyperelastic_cst"] = [
        first * adult.stiffness,
        first_power,
        second * adult.stiffness,
        second_power,
    ]
    _scale_circulation(own, adult)
    blocks = configuration["net"]["blocks"]
    for valve, name, narrowed, leak in (
        ("valve_atrium", "mitral", adult.mitral, adult.mitral_leak),
        ("valve_arterial", "aortic", adult.aortic, adult.aortic_leak),
    ):
        resistance = adult.valve / own[f"{valve}.conductance"] + STENOSIS[name] * (narrowed - 1.0)
        own[f"{valve}.conductance"] = size / resistance
        own[f"{valve}.inductance"] /= size
        own[f"{valve}.leak"] = size * (own["conductance_iso"] + LEAK[name] * leak / (1.0 - leak))
        blocks[valve]["backward_conductance"] = f"{valve}.leak"
    activation = configuration["update_functions"]["cavity.rheology.active_law.activation"]
    activation["reference_function"] = _stretched(activation["reference_function"], adult.systole)
    with redirect_stdout(StringIO()):  # the package shows its progress
        result = load(Configuration(reference.label, configuration)).run()["main"]
    last = result[result["time"] > (BEATS - 1) * adult.period - 0.5 * STEP].iloc[: round(adult.period / STEP)]
    if len(last) < round(adult.period / STEP):  # the package keeps what it has when its solver fails
        raise RuntimeError("The simulation stopped before its end")
    volume, pressure = (np.asarray(last[f"cavity.{name}"]) for name in ("volume", "blood_pressure"))
    return Beat(adult.period, volume / MILLILITRE, pressure / MMHG)


def _scale_circulation(own: dict[str, Any], adult: Adult) -> None:
    """Scale the atrium and the vessels."""
    distal, proximal = "circulation_aorta_distal", "circulation_aorta_proximal"
    own[f"{distal}.capacitance"] = own[f"{distal}.time_constant"] / own[f"{distal}.resistance"]
    for name in (f"{distal}.capacitance", f"{proximal}.capacitance"):
        own[name] *= adult.size * adult.compliance
    own["capacitance_valve.capacitance"] *= adult.size
    for name in (f"{distal}.resistance", f"{proximal}.resistance"):
        own[name] /= adult.size
    own[f"{distal}.resistance"] *= adult.resistance
    for name in ("atrial.blood_pressure.min", "atrial.blood_pressure.max"):
        own[name] = own[name] * adult.filling + STENOSIS["mitral"] * (adult.mitral - 1.0) * INFLOW


def _stretched(points: list[list[Any]], factor: float) -> list[list[Any]]:
    """Return the points of the activation with a longer contraction; the first two and the last stay."""
    start = points[1][0]
    return [
        [time if place in (0, len(points) - 1) else start + factor * (time - start), value]
        for place, (time, value) in enumerate(points)
    ]
