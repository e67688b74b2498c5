"""Closed loops of the package ModularCirc (MIT): Korakianitis and Shi 2006, and Naghavi et al. 2024.

Korakianitis T, Shi Y 2006, doi 10.1016/j.jbiomech.2005.05.016: two ventricles, valves that obey Bernoulli. Naghavi E et
al. 2024, doi 10.1016/j.compbiomed.2024.108275: a left heart, valves that are resistances.
"""

from typing import Any

import numpy as np
from ModularCirc.Models.KorakianitisMixedModel import KorakianitisMixedModel
from ModularCirc.Models.KorakianitisMixedModel_parameters import KorakianitisMixedModel_parameters
from ModularCirc.Models.NaghaviModel import NaghaviModel
from ModularCirc.Models.NaghaviModelParameters import NaghaviModelParameters
from ModularCirc.Solver import Solver

from benchmarks.other_worlds.adult import Adult, Beat

BEATS = 14
MILLISECOND = 1e-3
LEAK_SHARE = {"mi": 0.07, "ao": 0.09}
"""Regurgitant area, over that of the open valve, of a leak of all the stroke volume."""
LEAK_RESISTANCE = {"mv": 900.0, "av": 1100.0}
"""Resistance [mmHg ms/mL] of a leak of 0.3 of a stroke volume of 80 mL."""


def simulate_korakianitis(adult: Adult) -> Beat:
    """Simulate the last beat of Korakianitis and Shi."""
    own = KorakianitisMixedModel_parameters()
    size = adult.size
    for name in ("sas", "sat", "svn", "pas", "pat", "pvn"):
        vessel = own[name]
        vessel["r"] /= size
        vessel["c"] *= size
        vessel["v"] *= size * adult.filling
        if np.isfinite(np.float64(vessel["l"] if vessel["l"] is not None else np.nan)):
            vessel["l"] /= size
    own["sat"]["r"] *= adult.resistance
    own["sas"]["c"] *= adult.compliance
    own["sat"]["c"] *= adult.compliance
    for name in ("lv", "la", "rv", "ra"):
        _scale_chamber(own[name], size)
    for name in ("lv", "rv"):
        own[name]["E_act"] *= adult.contractility
        own[name]["E_pas"] *= adult.stiffness
        own[name]["tr"] *= adult.systole
        own[name]["td"] *= adult.systole
    for name in ("mi", "ao", "ti", "po"):
        own[name]["CQ"] *= size / np.sqrt(adult.valve)
    own["mi"]["CQ"] /= np.sqrt(adult.mitral)
    own["ao"]["CQ"] /= np.sqrt(adult.aortic)
    own["mi"]["RRA"] = LEAK_SHARE["mi"] * adult.mitral_leak
    own["ao"]["RRA"] = LEAK_SHARE["ao"] * adult.aortic_leak
    own["la"]["delay"] = own["ra"]["delay"] = adult.period - 0.1
    return _beat(KorakianitisMixedModel, own, adult.period, 1.0)


def simulate_naghavi(adult: Adult) -> Beat:
    """Simulate the last beat of Naghavi et al."""
    own = NaghaviModelParameters()
    size = adult.size
    for name in ("ao", "art", "ven"):
        vessel = own[name]
        vessel["r"] /= size
        vessel["c"] *= size
        vessel["v_ref"] *= size
        vessel["v"] *= size * adult.filling**0.25
    own["art"]["r"] *= adult.resistance
    own["ao"]["c"] *= adult.compliance
    own["art"]["c"] *= adult.compliance
    for name in ("lv", "la"):
        _scale_chamber(own[name], size)
    own["lv"]["E_act"] *= adult.contractility
    own["lv"]["E_pas"] *= adult.stiffness
    own["lv"]["t_max"] *= adult.systole
    own["lv"]["t_tr"] *= adult.systole
    own["la"]["delay"] = 1e3 * adult.period - 150.0
    for name, narrowed, leak in (
        ("mv", adult.mitral, adult.mitral_leak),
        ("av", adult.aortic, adult.aortic_leak),
    ):
        valve = own[name]
        valve["r"] *= adult.valve * narrowed / size
        share = valve["r"] / (LEAK_RESISTANCE[name] * 0.3 / leak / size) if leak else 0.0
        valve["max_func"] = _leaking(share)
    return _beat(NaghaviModel, own, adult.period, MILLISECOND)


def _leaking(share: float) -> Any:
    """Return the opening of a valve of which a share stays open to backward flow."""
    return lambda drop: np.maximum(drop, 0.0) + share * np.minimum(drop, 0.0)


def _scale_chamber(chamber: Any, size: float) -> None:
    chamber["E_act"] /= size
    chamber["k_pas"] /= size
    chamber["v_ref"] *= size
    chamber["v"] *= size


def _beat(model_class: Any, own: Any, period: float, second: float) -> Beat:
    """Simulate BEATS beats; second: unit of time of the model [s]."""
    setup = {
        "name": "bank",
        "ncycles": BEATS,
        "tcycle": period / second,
        "dt": 1e-3 / second,
        "export_min": 1,
    }
    model = model_class(time_setup_dict=setup, parobj=own, suppress_printing=True)
    solver = Solver(model=model)
    solver.setup(suppress_output=True, method="LSODA")
    solver.solve()
    ventricle, samples = model.components["lv"], round(period / 1e-3)
    volume, pressure = (
        np.asarray(series.values, float)[-samples:] for series in (ventricle.V, ventricle.P_i)
    )
    return Beat(period, volume, pressure)
