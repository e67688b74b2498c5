"""Closed loop of the package svzerod (BSD-3-Clause, SimVascular): four chambers, and no veins but the right atrium.

Sankaran S et al. 2012, doi 10.1007/s10439-012-0579-3, and Menon K et al. 2023, J Cardiovasc Transl Res 16:1099, as
svZeroDSolver's test case closedLoopHeart_singleVessel_decomposed has it: ventricles of an elastance whose course is a
Fourier series over the beat, atria that are exponential at rest, resistances for valves, and chambers with inertia. The
valves switch at once, as the solver fails at the steep ones of the case. Contraction lasts a fixed share of the beat:
the equations do not allow the factor systole, which is left out. As veins are missing, filling multiplies the blood by
its root. The published open aortic valve resists as a narrowed one does, so that a stenosis adds to its resistance.
"""

from typing import Any

import numpy as np
import svzerod

from benchmarks.other_worlds.adult import Adult, Beat

BEATS, STEP = 30, 1e-3
"""Number of beats until the last is kept, and the step [s]."""
ATRIAL = {"type": "wrapping_cosine", "Tsa": 0.40742, "tpwave": 8.976868}
ATRIA = {
    "RA": {"Emax": 0.208858, "Impedance": 0.000217032, "Kxp": 9.22244, "Kxv": 0.004837, "Vaso": 4.848742},
    "LA": {"Emax": 0.303119, "Impedance": 0.000351787, "Kxp": 9.194992, "Kxv": 0.008067, "Vaso": 9.355754},
}
VENTRICLES = {
    "RV": {"Emax": 2.098463, "Emin": 0.108573, "Impedance": 0.000186865, "Vrd": 9.424629, "Vrs": 9.424629},
    "LV": {"Emax": 3.085769, "Emin": 0.159656, "Impedance": 0.000110776, "Vrd": 5.606007, "Vrs": 5.606007},
}
"""Parameters [mmHg, mL, s] of the chambers; Impedance is the inertance at their outlet."""
POWERS = {"Kxp": 0.0, "Vaso": 1.0, "Vrd": 1.0, "Vrs": 1.0}
"""Powers of the size by which the parameters of a chamber grow; the others fall with it."""
VALVES = {
    "TV": ("RA", "RV", 0.007887459),
    "PV": ("RV", "lungs", 0.035061704),
    "MV": ("LA", "LV", 0.005310825),
    "AV": ("LV", "aorta", 0.034320234),
}
"""Chamber before, chamber or vessel after, and resistance [mmHg s/mL] of the open valve."""
VESSELS = {
    "lungs": ("BloodVesselRC", {"Rpd": 0.098865401, "Cp": 1.090989}),
    "aorta": ("BloodVessel", {"R_poiseuille": 0.0, "C": 0.556854}),
    "trunk": ("BloodVessel", {"R_poiseuille": 0.003348073, "L": 0.004}),
    "proximal": ("BloodVessel", {"R_poiseuille": 0.134156617, "C": 0.238401833}),
    "distal": ("BloodVessel", {"R_poiseuille": 1.356472458}),
}
JUNCTIONS = (
    ("lungs", "LA"),
    ("aorta", "trunk"),
    ("trunk", "proximal"),
    ("proximal", "distal"),
    ("distal", "RA"),
)
INITIAL = {"RA": 38.43, "RV": 96.07, "LA": 38.43, "LV": 96.07}
"""Volumes [mL] of the chambers, from which the empty vessels fill."""
CLOSED = 1e3
"""Resistance [mmHg s/mL] of a closed valve."""
STENOSIS = {"MV": 0.0053, "AV": 0.0075}
"""Resistance [mmHg s/mL] that a stenosis adds for each unit of its factor above 1."""
LEAK = {"MV": 0.5, "AV": 0.55}
"""Resistance [mmHg s/mL] of a leak of half of the stroke volume."""


def simulate(adult: Adult) -> Beat:
    """Simulate the last of several beats."""
    samples = round(adult.period / STEP)
    result = svzerod.simulate(
        {
            "simulation_parameters": {
                "number_of_cardiac_cycles": BEATS,
                "number_of_time_pts_per_cardiac_cycle": samples + 1,
                "cardiac_period": adult.period,
                "absolute_tolerance": 1e-8,
                "steady_initial": False,
                "output_variable_based": True,
                "output_all_cycles": False,
            },
            "boundary_conditions": [],
            "chambers": _chambers(adult),
            "valves": _valves(adult),
            "vessels": _vessels(adult),
            "junctions": [
                {
                    "junction_name": f"{before}_{after}",
                    "junction_type": "NORMAL_JUNCTION",
                    "inlet_blocks": [before],
                    "outlet_blocks": [after],
                }
                for before, after in JUNCTIONS
            ],
            "initial_condition": {
                f"Vc:{name}": volume * adult.size * adult.filling**0.5 for name, volume in INITIAL.items()
            },
        }
    )
    volume, pressure = (
        np.asarray(result["y"][result["name"] == name], float)[:samples]
        for name in ("Vc:LV", "pressure:MV:LV")
    )
    return Beat(adult.period, volume, pressure)


def _chambers(adult: Adult) -> list[dict[str, Any]]:
    """Return the chambers with the factors of an adult."""
    chambers = []
    for name, values in (ATRIA | VENTRICLES).items():
        own = {key: value * adult.size ** POWERS.get(key, -1.0) for key, value in values.items()}
        if name in VENTRICLES:
            own["Emax"] *= adult.contractility
            own["Emin"] *= adult.stiffness
        kind = "ChamberElastanceInductor" + ("" if name in VENTRICLES else "Exponential")
        course = {"type": "fourier"} if name in VENTRICLES else ATRIAL
        chambers.append({"type": kind, "name": name, "values": own, "activation_function": course})
    return chambers


def _valves(adult: Adult) -> list[dict[str, Any]]:
    """Return the valves with the factors of an adult."""
    narrowed = {"MV": adult.mitral, "AV": adult.aortic}
    leaks = {"MV": adult.mitral_leak, "AV": adult.aortic_leak}
    valves = []
    for name, (before, after, resistance) in VALVES.items():
        leak = leaks.get(name, 0.0)
        opened = resistance * adult.valve + STENOSIS.get(name, 0.0) * (narrowed.get(name, 1.0) - 1.0)
        own = {
            "Rmin": opened / adult.size,
            "Rmax": (LEAK[name] * (1.0 - leak) / leak if leak else CLOSED) / adult.size,
            "upstream_block": before,
            "downstream_block": after,
        }
        valves.append({"type": "PiecewiseValve", "name": name, "params": own})
    return valves


def _vessels(adult: Adult) -> list[dict[str, Any]]:
    """Return the vessels with the factors of an adult."""
    vessels = []
    for number, (name, (kind, values)) in enumerate(VESSELS.items(), 1):
        own = {key: value * adult.size ** (1.0 if key[0] == "C" else -1.0) for key, value in values.items()}
        if name == "distal":
            own["R_poiseuille"] *= adult.resistance
        elif name != "lungs" and "C" in own:
            own["C"] *= adult.compliance
        vessels.append(
            {
                "vessel_name": name,
                "vessel_id": number,
                "vessel_length": 10.0,
                "zero_d_element_type": kind,
                "zero_d_element_values": own,
            }
        )
    return vessels
