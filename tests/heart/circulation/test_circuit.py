"""The condensed circuit is solved to convergence, in every state of its valves."""

import numpy as np
import pytest

from heartfit.heart.circulation.circuit import Circuit
from heartfit.heart.circulation.elements import OrificeValve
from heartfit.heart.circulation.network import Circulation, Network
from heartfit.heart.circulation.network_step import NetworkStep
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation

ORIFICES = Circulation(
    mitral=OrificeValve(area=5e-4), aortic=OrificeValve(), tricuspid=OrificeValve(), pulmonary=OrificeValve()
)


def random_circuit(rng: np.random.Generator, circulation: Circulation) -> Circuit:
    dt = 10 ** rng.uniform(-3.5, -2.0)
    states = zip(circulation.trees(), circulation.start(0.8), strict=True)
    windkessels = np.array([tree.affine_pressure(state, dt) for tree, state in states])
    softness = rng.uniform(1e-9, 2e-8, 2)
    compliance = np.diag(softness) + 0.3 * softness.min() * (np.ones((2, 2)) - np.eye(2))
    start = rng.uniform([0.0, 0.0, 8e3, 1e3], [16e3, 5e3, 13e3, 3e3])
    network = NetworkStep(Network(circulation, (MitralRegurgitation(),)), rng.uniform(0.0, 0.8), dt, 0.8)
    return Circuit(network, windkessels, rng.uniform(-3e-6, 3e-6, 2), compliance, start)


@pytest.mark.parametrize("circulation", [Circulation(), ORIFICES], ids=["linear", "orifice"])
def test_both_balances_hold_at_the_solution(circulation: Circulation) -> None:
    """Ventricles to 1e-9 mL, arteries to 1e-6 Pa."""
    rng = np.random.default_rng(11)
    for _ in range(300):
        circuit = random_circuit(rng, circulation)
        pressures = circuit.solve()
        out, _ = circuit.network.outflow(pressures)
        response = circuit.compliance @ (pressures - circuit.start)[:2]
        ventricles = circuit.volume_change + response + circuit.network.dt * out[:2]
        arteries = pressures[2:] - circuit.windkessels[:, 0] + circuit.windkessels[:, 1] * out[2:]
        assert ventricles == pytest.approx(0.0, abs=1e-15)
        assert arteries == pytest.approx(0.0, abs=1e-6)
