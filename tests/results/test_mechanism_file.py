"""Every law of every region becomes a file that declares a mechanism with the effect of that law."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.cli.diagnose import run_mechanism_files
from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.cause import ActingPlace, Diagnosis, RankedLaw
from heartfit.discovery.sphere_model.forward_model import SphereForwardModel
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS
from heartfit.discovery.sphere_model.nominal_heart import ADULT
from heartfit.discovery.sphere_model.shown_place import law_state, zero_of
from heartfit.places import REGIONS, Region
from heartfit.places.laws import TIME_FORMS, Law, laws_of
from heartfit.places.periodic import PeriodicFunction
from heartfit.results.mechanism_file import TEMPLATES, mechanism_file
from heartfit.roles import Mechanism, registered
from heartfit.roles.registry import _REGISTRY

PERIOD = ADULT.heart.period
TIMES = np.arange(400) * PERIOD / 400
MODEL = SphereForwardModel(ADULT, {"lv_volume": TIMES, "lv_pressure": TIMES})
AT_MEAN = np.zeros(len(FREE_PARAMETERS))
SMALL = 0.1
"""Size of a law over its scale at which its effect is linear in it."""


SHAPES = {
    ("filling", "pulse"): 59,
    ("ejection", "pulse"): 26,
    ("leak", "pulse"): 26,
    ("backflow", "pulse"): 26,
    ("wall", "pulse"): 59,
    ("muscle", "pulse"): 8,
    ("images", "pulse"): 26,
    ("catheter", "pulse"): 26,
}
"""Pulses of 0.3 s, which eight harmonics resolve, at a time at which they act."""


def laws(region: Region) -> dict[str, Law]:
    simulated = MODEL.simulate(AT_MEAN)
    assert simulated is not None
    heart, beat = simulated
    state = law_state(beat, TIMES, zero_of(TIME_FORMS[region], heart))
    return {law.name: law for law in laws_of(region, state)}


CASES = [(region, law) for region in REGIONS for law in TEMPLATES[region]]


def unknown(region: str, law: RankedLaw) -> Diagnosis:
    acting = ActingPlace(region, "LeakFlow", "a slot", 12.0, (), (law,))
    return Diagnosis("unknown", (), (), "", (), 1, PERIOD, 5.0, acting=(acting,))


def effect(mechanism: Mechanism) -> Floats:
    with_it, alone = MODEL.predict(AT_MEAN, (mechanism,)), MODEL.predict(AT_MEAN, ())
    assert with_it is not None
    assert alone is not None
    scales = np.repeat([40e-6, 8e3], TIMES.size)
    return (with_it - alone) / scales


def declared(tmp_path, region: str, law: RankedLaw) -> Mechanism:  # type: ignore[no-untyped-def]
    path = tmp_path / "suggested.py"
    path.write_text(mechanism_file(unknown(region, law), "patient"))
    (name,) = run_mechanism_files([path])
    try:
        return registered()[name]()
    finally:
        _REGISTRY.pop(name)


def test_every_law_has_a_template() -> None:
    for region in REGIONS:
        assert set(laws(region)) == set(TEMPLATES[region])


@pytest.mark.parametrize(("region", "name"), CASES)
def test_a_written_mechanism_has_the_effect_of_its_law(tmp_path, region: Region, name: str) -> None:  # type: ignore[no-untyped-def]
    """The law's curve as a free function at the place of its region, to first order and to eight harmonics."""
    law = laws(region)[name]
    shape = SHAPES.get((region, name), 0)
    size = SMALL * law.scale
    ranked = RankedLaw(name, law.formula, size, law.unit, 0.0, law.shapes[shape])
    mechanism = declared(tmp_path, region, ranked)
    function = PeriodicFunction.from_samples(size * law.curves[shape], PERIOD)
    written, free = effect(mechanism), effect(TIME_FORMS[region](function))
    assert np.linalg.norm(written) > 1e-4
    assert written @ free / (np.linalg.norm(written) * np.linalg.norm(free)) > 0.95
    assert np.linalg.norm(written) == pytest.approx(np.linalg.norm(free), rel=0.15)


def test_a_written_mechanism_is_off_at_zero_and_has_the_size_as_its_scale(tmp_path) -> None:  # type: ignore[no-untyped-def]
    mechanism = declared(tmp_path, "leak", RankedLaw("orifice", "A", 0.2719e-4, "m^2", 0.0, {}))
    assert mechanism.switch().scale == pytest.approx(0.272e-4)
    assert not effect(mechanism.turned_off()).any()
    assert type(mechanism).__name__ == "SuggestedLeakOrifice"


def test_a_law_of_any_sign_may_become_negative(tmp_path) -> None:  # type: ignore[no-untyped-def]
    mechanism = declared(tmp_path, "images", RankedLaw("bow", "a", -0.03, "1", 0.0, {}))
    assert not mechanism.switch().one_sided
    assert replace(mechanism, size=0.03) != mechanism  # type: ignore[type-var]


def test_without_a_place_nothing_is_written() -> None:
    named = Diagnosis("none", (), (), "", (), 1, PERIOD, 5.0)
    with pytest.raises(
        InputError, match=r"the verdict of patient is 'none' without a place; expected an unknown"
    ):
        mechanism_file(named, "patient")
