"""Balances of a whole beat of the coarse specimen, and its reproducibility in other processes and element orders."""

from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from multiprocessing import get_context

import numpy as np
import pandas as pd

from heartfit.core.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat
from heartfit.heart.circulation.coupling import Tolerances
from heartfit.heart.circulation.state import HeartState
from heartfit.heart.finite_elements.body import FiniteElementBody
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.roles import Dynamics, registered
from verification.audit import Audit, audit, isovolumic_drift, lost_blood
from verification.block_checks import order
from verification.blood_audit import BloodAudit, audit_blood
from verification.check import Check
from verification.specimen import COARSE, END_DIASTOLIC_PRESSURE, specimen

USUAL_STEP, LONG_STEP = 5e-3, 10e-3
TIGHT = Tolerances(force=1e-6, volume=1e-15, pressure=1e-6, iterations=60)
"""Converged Newton iterations, so that the remainder is the error of the time scheme."""

SMALL = 1e-10


@dataclass(frozen=True)
class AuditedBeat:
    """A first beat with its states and their audits, of the wall and of the blood."""

    beat: Beat
    states: Sequence[HeartState]
    audit: Audit
    blood: BloodAudit

    @property
    def remainder(self) -> float:
        """Energy lost by the time scheme over the work of ejection [1]."""
        return self.audit.remainder / self.audit.ejecting

    @property
    def blood_remainder(self) -> float:
        """Energy of the blood that the time scheme loses, over the work of ejection [1]."""
        return self.blood.remainder / self.audit.ejecting


def audit_checks() -> list[Check]:
    """Check energy, blood volume, isovolumic phases, limit cycle and reproducibility."""
    fine, coarse, euler = watched(USUAL_STEP), watched(LONG_STEP), watched(LONG_STEP, second_order=False)
    blood = np.abs(lost_blood(Heart(), fine.states)).max() / np.ptp(fine.beat.volume["lv"])
    observed = order(abs(coarse.remainder), abs(fine.remainder))
    fibres = abs(fine.audit.fibre_gap) / fine.audit.ejecting
    drift, isovolumic = 100 * limit_cycle().diagnostics["drift"], 1e6 * isovolumic_drift(fine.beat)
    closed, same = "closes but for the error in time", "the same equations"
    return [
        Check("audit: energy lost over work, 5 ms", 100 * fine.remainder, 0.0, 0.2, "%", closed),
        Check("audit: order of it, 10 to 5 ms", observed, 2.0, 0.35, "1", "second-order steps"),
        Check(
            "audit: the same, backward Euler, 10 ms",
            100 * euler.remainder,
            17.0,
            3.0,
            "%",
            "a bound: it damps",
        ),
        Check(
            "audit: energy lost by fibres over work",
            fibres / SMALL,
            0.0,
            1.0,
            "1e-10",
            "balanced in each step",
        ),
        Check("audit: blood lost over stroke volume", blood / SMALL, 0.0, 1.0, "1e-10", "conserved"),
        Check("audit: isovolumic drift, 5 ms", isovolumic, 0.0, 0.1, "mL", "closed valves"),
        Check("audit: drift on the limit cycle", drift, 0.0, 1.0, "%", "periodic"),
        Check(
            "audit: two processes beside one", difference_on_two_processes() / SMALL, 0.0, 1.0, "1e-10", same
        ),
        Check("audit: elements in another order", difference_reordered() / SMALL, 0.0, 1.0, "1e-10", same),
    ]


def blood_checks() -> list[Check]:
    """Check the energy of the blood, with valves as they are and with inertance and leaflets in all four."""
    fine, coarse = watched(USUAL_STEP), watched(LONG_STEP)
    heart = heart_with_valve_dynamics()
    moving = watched(USUAL_STEP, heart=heart)
    blood = np.abs(lost_blood(heart, moving.states)).max() / np.ptp(moving.beat.volume["lv"])
    observed = order(abs(coarse.blood_remainder), abs(fine.blood_remainder))
    closed, four = "closes but for the error in time", "inertance and leaflets in four valves"
    return [
        Check("blood: energy lost over work, 5 ms", 100 * fine.blood_remainder, 0.0, 0.2, "%", closed),
        Check("blood: order of it, 10 to 5 ms", observed, 2.0, 0.35, "1", "second-order steps"),
        Check("blood: energy lost, moving valves", 100 * moving.blood_remainder, 0.0, 0.2, "%", four),
        Check("audit: energy lost, moving valves", 100 * moving.remainder, 0.0, 0.2, "%", four),
        Check("audit: blood lost, moving valves", blood / SMALL, 0.0, 1.0, "1e-10", "conserved"),
    ]


def heart_with_valve_dynamics() -> Heart:
    """Standard heart with inertance and leaflets in its four valves."""
    valves = (kind() for kind in registered().values() if issubclass(kind, Dynamics))
    return Heart(mechanisms=(*Heart().mechanisms, *valves))


@cache
def reference() -> VentricularMesh:
    """Stress-free reference of the coarse specimen."""
    return unload(specimen(COARSE), Heart().tissue, END_DIASTOLIC_PRESSURE)


@cache
def watched(time_step: float, second_order: bool = True, heart: Heart | None = None) -> AuditedBeat:
    """Simulate and audit the first beat of ``heart``, the standard one by default, at a time step [s]."""
    heart, states = heart or Heart(), list[HeartState]()
    body = FiniteElementBody(reference(), heart.muscle)
    beat = simulate(heart, body, _numerics(time_step, second_order), watch=states.extend)
    blood = audit_blood(heart, states, heart.period / (len(states) - 1))
    return AuditedBeat(beat, states, audit(body, states, heart.period, second_order), blood)


@cache
def limit_cycle() -> Beat:
    """Simulate to the beat at which the default criterion of periodicity stops."""
    heart = Heart()
    return simulate(heart, FiniteElementBody(reference(), heart.muscle), Numerics(time_step=LONG_STEP))


@cache
def difference_on_two_processes() -> float:
    """Largest relative difference of any curve between two parallel processes and this one."""
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        others = list(pool.map(curves, [reference()] * 2))
    return max(max_relative_difference(watched(LONG_STEP).beat.signals(), other) for other in others)


@cache
def difference_reordered() -> float:
    """Largest relative difference of any curve between two orders of the elements."""
    mesh = reference()
    shuffled = np.random.default_rng(0).permutation(len(mesh.tets))
    names = ("tets", "fibres", "orientation", "activation", "segments")
    fields = {name: getattr(mesh, name)[shuffled] for name in names}
    return max_relative_difference(watched(LONG_STEP).beat.signals(), curves(replace(mesh, **fields)))


def curves(mesh: VentricularMesh) -> dict[str, Floats]:
    """Curves of the first beat from a stress-free mesh."""
    heart = Heart()
    return simulate(heart, FiniteElementBody(mesh, heart.muscle), _numerics(LONG_STEP)).signals()


def max_relative_difference(first: dict[str, Floats], second: dict[str, Floats]) -> float:
    """Largest difference of any curve over its largest absolute value."""
    return max(float(np.abs(first[name] - second[name]).max() / np.abs(first[name]).max()) for name in first)


def _numerics(time_step: float, second_order: bool = True) -> Numerics:
    return Numerics(time_step=time_step, second_order=second_order, max_beats=1, tolerances=TIGHT)


def audit_table() -> pd.DataFrame:
    """Energies of the first beat [J], one column for a scheme and step."""
    columns = {
        "10 ms": watched(LONG_STEP),
        "5 ms": watched(USUAL_STEP),
        "10 ms, backward Euler": watched(LONG_STEP, second_order=False),
    }
    return _energies("J", {name: _lines(beat) for name, beat in columns.items()})


def blood_table() -> pd.DataFrame:
    """Energies of the blood in the first beat [J], one column for each kind of valves."""
    columns = {
        "valves without states": watched(USUAL_STEP),
        "with inertance and leaflets": watched(USUAL_STEP, heart=heart_with_valve_dynamics()),
    }
    return _energies("J, 5 ms", {name: _blood_lines(beat.blood) for name, beat in columns.items()})


def _blood_lines(blood: BloodAudit) -> dict[str, float]:
    return {
        "work of the atria": blood.atria,
        "work of the walls": blood.walls,
        "work that the arteries take": blood.arteries,
        **{f"lost in the {name} valve": energy for name, energy in blood.lost.items()},
        "stored: kinetic": blood.kinetic,
        "remainder": blood.remainder,
    }


def _lines(audited: AuditedBeat) -> dict[str, float]:
    ledger = audited.audit
    return {
        "work on the blood, left": -ledger.work["lv"],
        "work on the blood, right": -ledger.work["rv"],
        "brought by attaching bridges": ledger.supplied,
        **{f"stored: {name}": energy for name, energy in ledger.stored.items()},
        **{f"dissipated: {name}": energy for name, energy in ledger.dissipated.items()},
        "remainder": ledger.remainder,
    }


def _energies(head: str, columns: Mapping[str, Mapping[str, float]]) -> pd.DataFrame:
    table = pd.DataFrame(columns).map("{:.4f}".format)
    return table.rename_axis(head).reset_index()
