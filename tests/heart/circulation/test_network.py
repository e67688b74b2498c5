"""The circuit conserves blood at all pressures and with all leaks."""

from dataclasses import dataclass

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.heart.circulation.elements import OrificeValve
from heartfit.heart.circulation.network import Circulation, Network
from heartfit.heart.circulation.network_step import NetworkStep
from heartfit.mechanisms.atrial_kick import AtrialKick
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.roles import COMPARTMENTS, Flow
from heartfit.roles.laws import Branch
from heartfit.roles.sides import VALVES
from tests.shrinking import assert_derivative

CIRCULATIONS = [Circulation(), Circulation(mitral=OrificeValve(), aortic=OrificeValve())]
ENDS = {**VALVES, "MitralRegurgitation": ("lv", "left_atrium")}
LEAK = MitralRegurgitation(area=0.4e-4)
networks = pytest.mark.parametrize("circulation", CIRCULATIONS, ids=["linear", "orifice"])


def random_pressures(count: int) -> np.ndarray:
    rng = np.random.default_rng(5)
    return rng.uniform([-200.0, -200.0, 5e3, 500.0], [18e3, 6e3, 15e3, 3e3], (count, 4))


@networks
def test_flow_out_of_one_compartment_enters_another(circulation: Circulation) -> None:
    network = NetworkStep(Network(circulation, (AtrialKick(), LEAK)), 0.05, 5e-3, 0.8)
    for pressures in random_pressures(50):
        net = np.zeros(len(COMPARTMENTS))
        for name, flow in network.flows(pressures).items():
            for compartment, sign in zip(ENDS[name], (1.0, -1.0), strict=True):
                net[COMPARTMENTS.index(compartment)] += sign * flow
        assert network.outflow(pressures)[0] == pytest.approx(net[:4])
        assert net.sum() == pytest.approx(0.0, abs=1e-12 * abs(net).max())


@networks
def test_jacobian_is_the_derivative_of_the_outflow(circulation: Circulation) -> None:
    network = NetworkStep(Network(circulation, (LEAK,)), 0.05, 5e-3, 0.8)
    for pressures in random_pressures(20):
        direction = np.array([0.3, -0.2, 0.5, 0.4])
        slope = network.outflow(pressures)[1]
        assert_derivative(lambda p: network.outflow(p)[0], slope @ direction, pressures, direction)
        assert pytest.approx(slope.T) == slope
        assert (np.linalg.eigvalsh(slope) > 0.0).all()


def test_blood_runs_forward_through_open_valves_only() -> None:
    """Ejection: ventricles above arteries above atria."""
    network = NetworkStep(Network(Circulation(), ()), 0.3, 5e-3, 0.8)
    flow = network.flows(np.array([13e3, 4e3, 11e3, 2e3]))
    assert flow["aortic"] == pytest.approx(5e-6 * 2e3)
    assert flow["pulmonary"] == pytest.approx(5e-6 * 2e3)
    assert -2e-7 < flow["mitral"] < 0.0
    assert -2e-7 < flow["tricuspid"] < 0.0


def test_atria_have_their_resting_pressure_plus_the_kick() -> None:
    circulation, kick = Circulation(left_atrium=700.0, right_atrium=300.0), AtrialKick(rise=1000.0, right=0.5)
    assert circulation.atrial(0.5, 0.8, (kick,)) == pytest.approx([700.0, 300.0])
    assert circulation.atrial(kick.peak, 0.8, (kick,)) == pytest.approx([1700.0, 800.0])
    assert circulation.atrial(kick.peak, 0.8, ()) == pytest.approx([700.0, 300.0])


def test_a_time_dependent_branch_gives_laws_for_many_times() -> None:
    @dataclass(frozen=True)
    class Shutter(Flow):
        upstream, downstream = "aorta", "lv"

        def law(self, time: Floats) -> Branch:
            return Branch(area=1e-5 * time)

    network, times = Network(Circulation(), (Shutter(), LEAK)), np.array([0.1, 0.4])
    laws = network.laws(times)
    assert network.names == ["mitral", "aortic", "tricuspid", "pulmonary", "Shutter", "MitralRegurgitation"]
    assert laws[:, 4, 1] == pytest.approx(1e-5 * times)
    for n, time in enumerate(times):
        assert (network.laws(time) == laws[n]).all()


def test_what_time_prescribes_is_computed_once_a_time() -> None:
    network = Network(Circulation(), (AtrialKick(), LEAK))
    early = network.prescribed(0.1, 0.8)
    assert network.prescribed(0.1, 0.8) is early
    late = network.prescribed(0.5, 0.8)
    assert late.atrial == pytest.approx([600.0, 200.0])
    assert (early.atrial > late.atrial).all()
    assert (late.laws == network.laws(0.5)).all()


def test_networks_are_equal_that_have_equal_circulations_and_mechanisms() -> None:
    network = Network(Circulation(), (AtrialKick(), LEAK))
    assert network.equals(Network(Circulation(), [AtrialKick(), MitralRegurgitation(area=0.4e-4)]))
    assert not network.equals(Network(Circulation(), (AtrialKick(),)))
    assert not network.equals(Network(CIRCULATIONS[1], (AtrialKick(), LEAK)))
