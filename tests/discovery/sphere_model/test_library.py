"""The folder of mechanisms is the list of hypotheses."""

import numpy as np

from heartfit.discovery.sphere_model.forward_model import (
    BASE_COORDINATES,
    SphereForwardModel,
    candidates,
    hypothesis,
)
from heartfit.discovery.sphere_model.nominal_heart import ADULT, WITH_RIGHT
from heartfit.roles import registered
from heartfit.roles.sides import acts_within

FRAMES = np.arange(26) / 30
BOTH = SphereForwardModel(ADULT, {"lv_volume": FRAMES, "lv_pressure": FRAMES})


def test_every_observable_mechanism_that_the_heart_lacks_is_a_candidate():
    no_candidates = {"AtrialKick", "LeftAtrium", "RightAtrium"}
    no_candidates |= {"AorticDynamics", "TricuspidDynamics", "PulmonaryDynamics"}
    right = {name for name, kind in registered().items() if not acts_within(kind, 1)}
    assert set(candidates(BOTH)) == set(registered()) - no_candidates - right
    with_right = candidates(SphereForwardModel(WITH_RIGHT, {"lv_volume": FRAMES, "lv_pressure": FRAMES}))
    assert set(with_right) - set(candidates(BOTH)) == right - no_candidates
    assert {"TricuspidRegurgitation", "PulmonaryStenosis", "LateRightWall"} < right
    alone = candidates(SphereForwardModel(ADULT, {"lv_volume": FRAMES}))
    assert set(candidates(BOTH)) - set(alone) == {"CatheterDamping", "CatheterDelay", "CatheterOffset"}


def test_every_hypothesis_begins_with_the_same_coordinates_and_none_is_in_it():
    none = hypothesis(BOTH)
    assert none.coordinates == BASE_COORDINATES
    without = none.forward(none.at(0.0))
    for candidate in candidates(BOTH).values():
        single = hypothesis(BOTH, (candidate,))
        assert single.coordinates[: len(BASE_COORDINATES)] == BASE_COORDINATES
        assert single.amplitudes.sum() == 1
        assert np.array_equal(single.forward(single.at(0.0)), without), candidate.name
        assert not np.array_equal(single.forward(single.at(1.0)), without), candidate.name


def test_effects_combine():
    library = candidates(BOTH)
    pair = hypothesis(BOTH, (library["CatheterOffset"], library["MitralRegurgitation"]))
    assert pair.effects == ("CatheterOffset", "MitralRegurgitation")
    assert pair.amplitudes.sum() == 2
    leak = hypothesis(BOTH, (library["MitralRegurgitation"],))
    both, alone = pair.forward(pair.at(1.0)), leak.forward(leak.at(1.0))
    assert np.array_equal(both[:26], alone[:26])
    assert np.allclose(both[26:] - alone[26:], library["CatheterOffset"].unknowns[0].at(1.0))
