"""The verdict on places: which ones withdraw a name, which regions are told apart, and what the card draws of them."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from heartfit.discovery.inference.decide import DEFAULT_RULES
from heartfit.discovery.sphere_model import unknown_place as module
from heartfit.discovery.sphere_model.cause import ActingPlace, Cause, Diagnosis, PlaceFunction
from heartfit.discovery.sphere_model.law_ranking import FittedLaw
from heartfit.discovery.sphere_model.place_search import FittedPlace
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording
from heartfit.discovery.sphere_model.unknown_place import ShownPlace, locate
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.places import (
    PLACES,
    AorticLoss,
    LeakFlow,
    LeakPassage,
    Place,
    SystolicPressureError,
    WallPressure,
)
from heartfit.places.laws import Law

LEAK = Cause("MitralRegurgitation", 8.0, 3e-5, "m^2", (2e-5, 4e-5))
PERIOD = 0.8


@dataclass
class Gained:
    """Stand-in for a held-out prediction with this gain in ln likelihood."""

    gain: float

    def helps(self) -> bool:
        return self.gain > 0.0

    def gains(self) -> tuple[str, ...]:
        return (f"gain of {self.gain:g}",)


@dataclass
class Searched:
    """Stand-in for a searched recording of volume and pressure."""

    searched: tuple[str, ...] = ("lv_volume", "lv_pressure")
    rules: object = DEFAULT_RULES
    data: None = None
    model: None = None
    library: Mapping[str, object] = field(
        default_factory=lambda: {"MitralRegurgitation": SimpleNamespace(kind=MitralRegurgitation)}
    )

    @property
    def recording(self) -> SimpleNamespace:
        return SimpleNamespace(searched=self.searched)

    @property
    def findings(self) -> SimpleNamespace:
        return SimpleNamespace(survey=SimpleNamespace(baseline=None))


def diagnosis(verdict: str, *causes: Cause) -> Diagnosis:
    return Diagnosis(verdict, causes, (("Scar",),), "", (), 10, PERIOD, 5.0)  # type: ignore[arg-type]


def place(kind: type[Place], factor: float) -> FittedPlace:
    return FittedPlace(kind, cast("object", SimpleNamespace(fit=SimpleNamespace(x=kind.__name__))), factor)  # type: ignore[arg-type]


def shown(search: object, fitted: FittedPlace) -> SimpleNamespace:
    acting = ActingPlace(fitted.region, fitted.kind.__name__, fitted.kind.slot, fitted.ln_bayes_factor)
    return SimpleNamespace(acting=lambda: acting, function=lambda: cast("PlaceFunction", fitted.region))


def located(
    monkeypatch: pytest.MonkeyPatch,
    before: Diagnosis,
    places: Mapping[type[Place], float],
    refuted: tuple[type[Place], ...] = (),
    case: Searched | None = None,
) -> Diagnosis:
    """Diagnosis with places of these ln Bayes factors, of which the refuted ones do not help on held-out samples."""
    fitted = tuple(place(kind, factor) for kind, factor in places.items())

    def gained(_: object, __: object, x: str, ___: object) -> list[Gained]:
        return [Gained(-1.0 if x in {kind.__name__ for kind in refuted} else 2.0)]

    search = SimpleNamespace(run=lambda _: fitted)
    monkeypatch.setattr(module, "PlaceSearch", lambda *_: search)
    monkeypatch.setattr(module, "FitContext", lambda _: SimpleNamespace(simulations=7))
    monkeypatch.setattr(module, "predict_extension", gained)
    monkeypatch.setattr(module.ShownPlace, "from_search", shown)
    return locate(before, cast("SearchedRecording", case or Searched()), {}, PLACES)


def regions(diagnosed: Diagnosis) -> list[str]:
    return [one.region for one in diagnosed.acting]


def test_without_a_name_the_best_region_is_where_something_acts(monkeypatch: pytest.MonkeyPatch) -> None:
    diagnosed = located(monkeypatch, diagnosis("none"), {LeakPassage: 12.0, LeakFlow: 9.0, WallPressure: 6.0})
    assert (diagnosed.verdict, regions(diagnosed), diagnosed.simulations) == ("unknown", ["leak"], 17)
    assert diagnosed.acting[0].place == "LeakPassage"
    assert diagnosed.gain == ("gain of 2",)
    assert diagnosed.alternatives == ()


def test_regions_within_the_lead_are_not_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    diagnosed = located(
        monkeypatch, diagnosis("none"), {AorticLoss: 12.0, SystolicPressureError: 9.5, WallPressure: 8.9}
    )
    assert regions(diagnosed) == ["ejection", "catheter"]
    assert len(diagnosed.functions) == 2


def test_a_weak_place_is_no_finding(monkeypatch: pytest.MonkeyPatch) -> None:
    diagnosed = located(monkeypatch, diagnosis("none"), {WallPressure: 4.9})
    assert (diagnosed.verdict, diagnosed.acting, diagnosed.simulations) == ("none", (), 17)


def test_a_place_that_does_not_help_on_held_out_samples_is_no_finding(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    places: dict[type[Place], float] = {WallPressure: 12.0, LeakPassage: 7.0}
    diagnosed = located(monkeypatch, diagnosis("none"), places, (WallPressure,))
    assert regions(diagnosed) == ["leak"]


@pytest.mark.parametrize(
    ("kind", "factor", "verdict"),
    [(AorticLoss, 9.0, "unknown"), (AorticLoss, 7.0, "named"), (LeakFlow, 30.0, "named")],
    ids=["a stronger place elsewhere", "a weaker place elsewhere", "a place of its own region"],
)
def test_a_name_stands_against_places_of_other_regions(
    monkeypatch: pytest.MonkeyPatch, kind: type[Place], factor: float, verdict: str
) -> None:
    diagnosed = located(monkeypatch, diagnosis("named", LEAK), {kind: factor})
    assert diagnosed.verdict == verdict
    assert diagnosed.withdrawn == (("MitralRegurgitation",) if verdict == "unknown" else ())
    assert diagnosed.mechanisms == (() if verdict == "unknown" else (LEAK,))


def test_a_volume_alone_and_no_places_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    before = diagnosis("none")
    alone = located(monkeypatch, before, {WallPressure: 12.0}, case=Searched(searched=("lv_volume",)))
    assert alone is before
    assert locate(before, cast("SearchedRecording", Searched()), {}, ()) is before


def test_the_clear_spans_of_a_function_follow_the_trigger() -> None:
    """A function that is clear from 0.2 to 0.3 s after the trigger, and about the end of the beat."""
    times = np.arange(200) * PERIOD / 200
    after = np.mod(times - 0.1, PERIOD)
    mean = np.where((after > 0.2) & (after < 0.3), 5e-5, np.where(after > 0.75, -3e-5, 1e-6))
    law = Law("orifice", "A", "m^2", 2e-5, np.ones((1, 200)))
    place_shown = ShownPlace(
        place(LeakPassage, 12.0), LeakFlow, times, after, mean, np.full(200, 1e-5),
        (FittedLaw(law, -4.0, 0, 2e-5), FittedLaw(law, -9.0, 0, 1e-5)),
    )  # fmt: skip
    acting, function = place_shown.acting(), place_shown.function()
    first, second = acting.spans
    assert (first.size, second.size) == (5e-5, -3e-5)
    assert (first.start, first.end) == pytest.approx((0.2, 0.3), abs=0.005)
    assert (second.start, second.end) == pytest.approx((0.75, 0.8), abs=0.005)
    assert [one.ln_likelihood for one in acting.laws] == [0.0, -5.0]
    assert np.all(np.diff(function.times) > 0.0)
    assert function.mean[(function.times > 0.21) & (function.times < 0.29)] == pytest.approx(5e-5)
    assert function.law == pytest.approx(2e-5)
