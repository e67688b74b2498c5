"""A clearly observable effect has a small detection limit; an effect that the model absorbs has none."""

import pytest

from heartfit.discovery.sphere_model import limits as module
from heartfit.discovery.sphere_model.limits import detection_limits


@pytest.mark.usefixtures("coarse_search")
def test_a_delay_is_detectable_and_a_scar_is_not(monkeypatch: pytest.MonkeyPatch) -> None:
    """At the least and the largest size."""
    monkeypatch.setattr(module, "SIZES", (module.SIZES[0], module.SIZES[-1]))
    limits = {
        (limit.name, limit.sign): limit for limit in detection_limits(1, names=("CatheterDelay", "Scar"))
    }
    assert set(limits) == {("CatheterDelay", 1.0), ("CatheterDelay", -1.0), ("Scar", 1.0)}
    late, scar = limits["CatheterDelay", 1.0], limits["Scar", 1.0]
    assert 0.015 < late.amplitude < 0.025, "the trigger of a recording is known to 20 ms"
    assert scar.least is scar.amplitude is None
    assert max(scar.factors) < 5.0
