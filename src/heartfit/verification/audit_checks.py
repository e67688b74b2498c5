"""A whole beat of the coarse specimen held to its balances, and to itself on other processes and meshes."""

from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from multiprocessing import get_context

import numpy as np

from heartfit.beat import Beat
from heartfit.circulation.coupling import HeartState, Tolerances
from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart import Heart
from heartfit.mechanics.body import FiniteElementBody
from heartfit.mechanics.unloading import unload
from heartfit.simulation import Numerics, simulate
from heartfit.verification.audit import Audit, audit
from heartfit.verification.audit_blood import isovolumic_drift, lost_blood
from heartfit.verification.check import Check
from heartfit.verification.convergence import order
from heartfit.verification.specimen import COARSE, END_DIASTOLIC_PRESSURE, specimen

USUAL_STEP, LONG_STEP = 5e-3, 10e-3
TIGHT = Tolerances(force=1e-6, volume=1e-15, pressure=1e-6, iterations=60)
"""Newton's method to the end, so that what is left over is the scheme's."""

SMALL = 1e-10


@dataclass(frozen=True)
class Watched:
    """A first beat with its states and their audit."""

    beat: Beat
    states: Sequence[HeartState]
    audit: Audit

    @property
    def remainder(self) -> float:
        """Energy that the time scheme lost, over the work of ejection."""
        return self.audit.remainder / self.audit.ejecting


def audit_checks() -> list[Check]:
    """Energy, blood, isovolumic phases, limit cycle, and sameness."""
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
        Check("audit: two processes beside one", apart_on_two_processes() / SMALL, 0.0, 1.0, "1e-10", same),
        Check("audit: elements in another order", apart_reordered() / SMALL, 0.0, 1.0, "1e-10", same),
    ]


@cache
def reference() -> VentricularMesh:
    """The coarse specimen without stress."""
    return unload(specimen(COARSE), Heart().tissue, END_DIASTOLIC_PRESSURE)


@cache
def watched(time_step: float, second_order: bool = True) -> Watched:
    """The first beat at a time step, s."""
    heart, states = Heart(), list[HeartState]()
    body = FiniteElementBody(reference(), heart.muscle)
    beat = simulate(heart, body, _numerics(time_step, second_order), watch=states.extend)
    return Watched(beat, states, audit(body, states, heart.period, second_order))


@cache
def limit_cycle() -> Beat:
    """The beat at which the usual criterion stops."""
    heart = Heart()
    return simulate(heart, FiniteElementBody(reference(), heart.muscle), Numerics(time_step=LONG_STEP))


@cache
def apart_on_two_processes() -> float:
    """Largest relative difference of any curve between two processes at once and this one."""
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        others = list(pool.map(curves, [reference()] * 2))
    return max(apart(watched(LONG_STEP).beat.signals(), other) for other in others)


@cache
def apart_reordered() -> float:
    """The same between two orders of the elements."""
    mesh = reference()
    shuffled = np.random.default_rng(0).permutation(len(mesh.tets))
    names = ("tets", "fibres", "orientation", "activation", "segments")
    fields = {name: getattr(mesh, name)[shuffled] for name in names}
    return apart(watched(LONG_STEP).beat.signals(), curves(replace(mesh, **fields)))


def curves(mesh: VentricularMesh) -> dict[str, Floats]:
    """Every curve of the first beat from a stress-free mesh."""
    heart = Heart()
    return simulate(heart, FiniteElementBody(mesh, heart.muscle), _numerics(LONG_STEP)).signals()


def apart(first: dict[str, Floats], second: dict[str, Floats]) -> float:
    """Largest difference of a curve over its largest value."""
    return max(float(np.abs(first[name] - second[name]).max() / np.abs(first[name]).max()) for name in first)


def _numerics(time_step: float, second_order: bool = True) -> Numerics:
    return Numerics(time_step=time_step, second_order=second_order, max_beats=1, tolerances=TIGHT)
