"""A narrowing in series with a valve: the drops of both add up, for conductances and for orifices."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from heartfit.heart.circulation.elements import LinearValve, OrificeValve
from heartfit.heart.circulation.network import Circulation, Network
from heartfit.mechanisms.aortic_stenosis import AorticStenosis
from heartfit.roles import Narrowing
from heartfit.roles.laws import BLOOD_DENSITY, NO_LEAFLETS, Branch, branch_flow, inertial_flow
from heartfit.roles.sides import VALVES
from tests.shrinking import assert_derivative

LINEAR, ORIFICE = LinearValve(open=4e-6).law(), OrificeValve(area=4e-4).law()
AREA = 1.2e-4
LOSS = 0.5 * BLOOD_DENSITY / AREA**2
laws = pytest.mark.parametrize("law", [LINEAR, ORIFICE], ids=["linear", "orifice"])
DROPS = [1e-3, 30.0, 400.0, 6e3, 3e4]


@pytest.mark.parametrize("drop", DROPS)
def test_a_conductance_and_a_narrowing_combine_in_closed_form(drop: float) -> None:
    """The drop is q / K + (rho / 2) q^2 / A^2."""
    q, _ = LINEAR.with_narrowing(AREA**-2).flow(drop)
    assert q / LINEAR.conductance + LOSS * q * q == pytest.approx(drop, rel=1e-13)


@pytest.mark.parametrize("drop", [1e3, 6e3, 3e4])
def test_two_orifices_share_the_drop(drop: float) -> None:
    """Beyond the smoothing, where both obey Bernoulli's law."""
    q, _ = ORIFICE.with_narrowing(AREA**-2).flow(drop)
    assert 0.5 * BLOOD_DENSITY * q**2 * (4e-4**-2 + AREA**-2) == pytest.approx(drop, rel=1e-3)


@laws
def test_narrowings_one_behind_the_other_add_up(law: Branch) -> None:
    once = law.with_narrowing(3e7).with_narrowing(5e7)
    assert once == pytest.approx(law.with_narrowing(8e7), rel=1e-14)


@laws
@pytest.mark.parametrize("drop", DROPS)
def test_the_slope_is_the_derivative_of_the_flow(law: Branch, drop: float) -> None:
    narrow, x, step = law.with_narrowing(AREA**-2), np.array([drop]), np.array([0.1 * drop])
    assert_derivative(lambda p: np.array([narrow.flow(p[0])[0]]), narrow.flow(drop)[1] * step, x, step)


@laws
def test_a_narrower_valve_has_less_flow_and_closes_as_before(law: Branch) -> None:
    drops = np.linspace(-2e4, 2e4, 401)
    flows = [[law.with_narrowing(a).flow(drop)[0] for drop in drops] for a in (0.0, 1e7, 1e8)]
    assert (np.diff(flows, axis=1) > 0.0).all()
    ahead = drops > 0.0
    assert (np.diff(np.array(flows)[:, ahead], axis=0) < 0.0).all()
    assert (np.diff(np.array(flows)[:, ~ahead], axis=0) == 0.0).all()


@laws
def test_a_narrowing_of_zero_resistance_changes_no_flow(law: Branch) -> None:
    """Equal to the bit."""
    assert all(law.with_narrowing(0.0).flow(drop) == law.flow(drop) for drop in (-50.0, 0.0, 7.0, 123.4, 9e3))


@laws
def test_a_narrowing_acts_on_blood_with_inertia(law: Branch) -> None:
    table = np.array([[law.with_narrowing(AREA**-2)]])
    q, _, _ = inertial_flow(table, 0, 0, 5e3, NO_LEAFLETS, 3e6, 2e-4)
    assert q == pytest.approx(branch_flow(table, 0, 0, 5e3 - 3e6 * (q - 2e-4))[0], rel=1e-9)


def test_a_conductance_beside_an_orifice_has_no_closed_form() -> None:
    with pytest.raises(ValueError, match=r"conductance.*orifice"):
        Branch(conductance=1e-6, area=1e-4).with_narrowing(1e7)


def test_stenosis_narrows_only_the_valve_that_it_names() -> None:
    @dataclass(frozen=True)
    class Tight(Narrowing):
        valve = "tricuspid"

        def inverse_square(self) -> float:
            return 1e8

    circulation = replace(Circulation(), aortic=OrificeValve())
    plain = Network(circulation, ()).laws(0.1)
    narrowed = Network(circulation, (Tight(), AorticStenosis())).laws(0.1)
    changed = (narrowed != plain).any(axis=-1)
    assert dict(zip(VALVES, changed.tolist(), strict=True)) == {
        "mitral": False,
        "aortic": True,
        "tricuspid": True,
        "pulmonary": False,
    }
