r"""Closed circuit of four chambers of variable elastance, beside the same circuit of the package circulation.

Ventricles :math:`P = E(t) (V - V_0)`, atria of the same law, valves as diodes of two resistances, arteries and veins as
a resistance and a compliance each. Its inertances of arteries and veins are set to :math:`10^{-7}` mmHg s^2/mL, since
ours have none, and its atria contract from 0.7 s of 0.8 s on. The table holds its periodic beat.

Source: Regazzoni et al., J Comput Phys 2022, 457:111083; equations and constants as in Regazzoni2020 of circulation
0.4.0 (H. Finsberg, MIT licence), integrated by scipy's BDF with rtol 1e-8 until two beats agree to 1e-5 mL and mmHg.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter
from heartfit.heart.beat import Beat
from heartfit.heart.circulation.coupling import Tolerances
from heartfit.heart.circulation.elements import LinearValve, Windkessel
from heartfit.heart.circulation.network import Circulation
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.mechanisms.left_atrium import LeftAtrium
from heartfit.mechanisms.right_atrium import RightAtrium
from heartfit.roles import Contraction
from verification.check import Check
from verification.elastance import Elastance, ElastanceBody

MILLILITRE, MMHG = 1e-6, 133.322
RESISTANCE, ELASTANCE = MMHG / MILLILITRE, MMHG / MILLILITRE
PERIOD = 0.8
TABLE = Path(__file__).parent / "closed_loop.csv"
TABLE_HEADER = 3
"""Lines before the names of the columns."""

ARTERIAL, VENOUS = np.array([1.372, 20.0]), np.array([11.363, 16.0])
"""Compliances [mL/mmHg] of systemic and pulmonary arteries and veins."""

ATRIAL = Elastance(1.0, 0.0, 0.0, onset=0.7, rise=0.17, fall=0.17)
"""Contraction of both atria."""

COLUMNS = {
    "V_LA": ("volume", "left_atrium"),
    "V_LV": ("volume", "lv"),
    "V_RA": ("volume", "right_atrium"),
    "V_RV": ("volume", "rv"),
    "p_LA": ("pressure", "left_atrium"),
    "p_LV": ("pressure", "lv"),
    "p_RA": ("pressure", "right_atrium"),
    "p_RV": ("pressure", "rv"),
    "p_AR_SYS": ("pressure", "aorta"),
    "p_AR_PUL": ("pressure", "pulmonary_artery"),
}
"""Curves of a beat, by column of the table [mL], [mmHg]."""


@dataclass(frozen=True)
class HalfCosines(Contraction):
    """Contraction of both atria by half cosines; it adds no pressure."""

    compartments = ("left_atrium", "right_atrium")
    size: float = parameter(1.0, unit="1", symbol="e", meaning="size of the contraction", off=0.0)

    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:  # noqa: ARG002
        return np.zeros(np.shape(time))

    def contraction(self, time: Floats, period: float) -> Floats:
        return self.size * ATRIAL.contraction(time, period)


def closed_heart() -> Heart:
    """Circuit of the case, relaxed at the start; its systemic veins hold what the rest lacks of the blood."""
    valve = LinearValve(1.0 / (0.0075 * RESISTANCE), 1.0 / (75006.2 * RESISTANCE))
    circulation = Circulation(
        systemic=_arteries(0.733, ARTERIAL[0]),
        pulmonary_tree=_arteries(0.046, ARTERIAL[1]),
        mitral=valve,
        aortic=valve,
        tricuspid=valve,
        pulmonary=valve,
        left_atrium=0.18 * 76.0 * MMHG,
        right_atrium=0.07 * 66.0 * MMHG,
    )
    rest = np.array([80.0, 70.0, 42.0 + 0.18 * 76.0 / 0.17, 16.0 + 0.07 * 66.0 / 0.029])
    held = np.array([tree.P_c for tree in circulation.start(PERIOD)]) / MMHG
    pulmonary_veins = 16.0
    lacking = blood() - rest.sum() - held @ ARTERIAL - pulmonary_veins * VENOUS[1]
    left = LeftAtrium(**_chamber(0.0015, pulmonary_veins, VENOUS[1], 0.18, 0.07))
    right = RightAtrium(**_chamber(0.32, lacking / VENOUS[0], VENOUS[0], 0.07, 0.06))
    return Heart(circulation=circulation, mechanisms=(HalfCosines(), left, right), period=PERIOD)


def _arteries(resistance: float, compliance: float) -> Windkessel:
    R_p = resistance * RESISTANCE
    return Windkessel(R_p, tau=resistance * compliance, Z_c=1e2, L=1e2, P_ve=0.0)


def _linear(elastance: float, volume: float) -> float:
    """Pressure [Pa] of a relaxed atrium of ``volume`` [mL]."""
    return elastance * (volume - 4.0) * MMHG


def _chamber(
    resistance: float, vein: float, compliance: float, passive: float, active: float
) -> dict[str, float]:
    """Parameters of an atrium and its veins; a wall that stiffens over 1 m^3 is linear."""
    return {
        "resistance": resistance * RESISTANCE,
        "reservoir": vein * MMHG,
        "veins": ELASTANCE / compliance,
        "unstressed": 4.0 * MILLILITRE,
        "passive": passive * ELASTANCE,
        "active": active * ELASTANCE,
        "scale": 1.0,
    }


def ventricles() -> ElastanceBody:
    """Ventricles of the case."""
    left = Elastance(4.482 * ELASTANCE, 0.17 * ELASTANCE, 42.0 * MILLILITRE, onset=0.1)
    right = Elastance(0.2 * ELASTANCE, 0.029 * ELASTANCE, 16.0 * MILLILITRE, onset=0.1)
    return ElastanceBody(left, right)


def published() -> dict[str, Floats]:
    """Columns (81,) of the table by name."""
    table = np.genfromtxt(TABLE, delimiter=",", names=True, skip_header=TABLE_HEADER)
    return {str(name): table[name] for name in table.dtype.names or ()}


def blood() -> float:
    """Blood [mL] of the table: in chambers, arteries and veins."""
    first = {name: column[0] for name, column in published().items()}
    chambers = sum(value for name, value in first.items() if name.startswith("V_"))
    arteries = np.array([first["p_AR_SYS"], first["p_AR_PUL"]]) @ ARTERIAL
    return float(chambers + arteries + np.array([first["p_VEN_SYS"], first["p_VEN_PUL"]]) @ VENOUS)


def closed_beat(steps: int = 200, beats: int = 60) -> Beat:
    """Periodic beat of the case in our circuit, in ``steps`` steps."""
    strict = Tolerances(force=1e-5, volume=1e-14, pressure=1e-4, iterations=60)
    numerics = Numerics(PERIOD / steps, max_beats=beats, drift=1e-5, tolerances=strict)
    return simulate(closed_heart(), ventricles(), numerics)


def departures(beat: Beat) -> dict[str, float]:
    """Largest difference of every curve to the table, over the range of the table."""
    table, result = published(), {}
    for name, (kind, place) in COLUMNS.items():
        unit = MILLILITRE if kind == "volume" else MMHG
        ours = np.interp(table["t"], beat.time, getattr(beat, kind)[place]) / unit
        result[name] = float(np.abs(ours - table[name]).max() / np.ptp(table[name]))
    return result


def closed_loop_checks() -> list[Check]:
    """Check each curve to 1 % of its range."""
    source = "circulation 0.4.0, Regazzoni2020"
    return [
        Check(f"closed circuit: {name}", 100.0 * value, 0.0, 1.0, "% of range", source)
        for name, value in departures(closed_beat()).items()
    ]
