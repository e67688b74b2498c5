"""Closed loop of Regazzoni et al. 2020, as the package circulation (MIT) has it; valves are resistances.

Regazzoni F et al. 2022, doi 10.1016/j.jcp.2022.111083.
"""

import logging
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from circulation.base import remove_units
from circulation.regazzoni2020 import Regazzoni2020

from benchmarks.other_worlds.adult import Adult, Beat

logging.disable(logging.CRITICAL)
BEATS, STEP = 14, 1e-3
"""Number of beats until the last is kept, and the step of the package's solver [s]."""
MITRAL, AORTIC = 0.9, 1.1
"""Resistance [mmHg s/mL] of a leak of 0.3 of a stroke volume of 80 mL."""
VOLUMES = ("V_LA", "V_LV", "V_RA", "V_RV")


def simulate(adult: Adult) -> Beat:
    """Simulate the last of several beats."""
    parameters = remove_units(Regazzoni2020.default_parameters())
    initial = remove_units(Regazzoni2020.default_initial_conditions())
    beat, size = adult.period / 0.8, adult.size
    parameters["HR"] = 1.0 / adult.period
    for name, chamber in parameters["chambers"].items():
        chamber["EA"] /= size
        chamber["EB"] /= size
        chamber["V0"] *= size
        chamber["tC"] *= beat
        if name in ("LV", "RV"):
            chamber["EA"] *= adult.contractility
            chamber["EB"] *= adult.stiffness
            chamber["TC"] *= adult.systole
    valves = parameters["valves"]
    for valve in valves.values():
        valve["Rmin"] *= adult.valve / size
        valve["Rmax"] /= size
    valves["MV"]["Rmin"] *= adult.mitral
    valves["AV"]["Rmin"] *= adult.aortic
    if adult.mitral_leak:
        valves["MV"]["Rmax"] = MITRAL * 0.3 / adult.mitral_leak / size
    if adult.aortic_leak:
        valves["AV"]["Rmax"] = AORTIC * 0.3 / adult.aortic_leak / size
    for side in ("SYS", "PUL"):
        tree = parameters["circulation"][side]
        for name in ("R_AR", "R_VEN", "L_AR", "L_VEN"):
            tree[name] /= size
        for name in ("C_AR", "C_VEN"):
            tree[name] *= size
    parameters["circulation"]["SYS"]["R_AR"] *= adult.resistance
    parameters["circulation"]["SYS"]["C_AR"] *= adult.compliance
    for name in initial:
        if not name.startswith("p_"):
            initial[name] *= size
    for name in (*VOLUMES, "p_VEN_SYS", "p_VEN_PUL"):
        initial[name] *= adult.filling
    with TemporaryDirectory() as folder:  # the package writes its states beside the results
        model = Regazzoni2020(parameters, initial_state=initial, outdir=Path(folder))
        result = model.solve(T=BEATS * adult.period, dt=STEP, dt_eval=STEP)
    last = np.asarray(result["time"]) >= (BEATS - 1) * adult.period
    return Beat(adult.period, np.asarray(result["V_LV"])[last], np.asarray(result["p_LV"])[last])
