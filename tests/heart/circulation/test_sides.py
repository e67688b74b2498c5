"""Sides of the heart: what acts in them, and the blood that a beat moves."""

import numpy as np
import pytest

from heartfit.mechanisms.tricuspid_regurgitation import TricuspidRegurgitation
from heartfit.roles import COMPARTMENTS, Mechanism, registered
from heartfit.roles.sides import VALVES, acts_within, compartments_of, net_inflow


def test_a_leak_returns_what_it_takes_to_the_compartment_behind_it() -> None:
    """Flows of 90 and 70 mL/s through both valves of the right side, and 20 mL/s back to its atrium."""
    flows = {
        "tricuspid": np.full(5, 90e-6),
        "pulmonary": np.array(
            [9.0, 0.0, 0.0, 140e-6, 140e-6]
        ),  # the first sample repeats the last of the beat
        "TricuspidRegurgitation": np.full(5, 20e-6),
    }
    inflow = net_inflow(flows, (TricuspidRegurgitation(),))
    assert inflow["rv"] == pytest.approx(0.0, abs=1e-15)
    assert inflow["right_atrium"] == pytest.approx(-70e-6)
    assert inflow["pulmonary_artery"] == pytest.approx(70e-6)
    assert sum(inflow.values()) == pytest.approx(0.0, abs=1e-15)
    assert inflow.keys() == set(COMPARTMENTS)


def test_the_left_side_has_the_left_valves() -> None:
    left = compartments_of(1)
    assert {name for name, ends in VALVES.items() if left >= {*ends}} == {"mitral", "aortic"}
    assert compartments_of(2) == set(COMPARTMENTS)


@pytest.mark.parametrize("kind", registered().values(), ids=registered().keys())
def test_what_acts_on_the_right_side_alone_is_known_by_its_slot(kind: type[Mechanism]) -> None:
    right = ("Tricuspid", "Pulmonary", "LateRight")
    assert acts_within(kind, 2)
    assert acts_within(kind, 1) == (not kind.__name__.startswith(right))
