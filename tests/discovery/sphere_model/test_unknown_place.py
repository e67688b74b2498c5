"""The verdict on places: which ones withdraw a name, which regions are told apart, and what the card draws of them."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import cast

import pytest

from heartfit.discovery.inference.decide import DEFAULT_RULES, BesideProcess
from heartfit.discovery.inference.evidence import Explanation
from heartfit.discovery.sphere_model import unknown_place as module
from heartfit.discovery.sphere_model.cause import (
    ActingPlace,
    Cause,
    Diagnosis,
    PlaceFunction,
    UnnamedCandidate,
)
from heartfit.discovery.sphere_model.place_search import FittedPlace, RankedPlaces
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording
from heartfit.discovery.sphere_model.unknown_place import locate
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.mechanisms.scar import Scar
from heartfit.places import PLACES, Place
from heartfit.places.library import AorticLoss, LeakFlow, LeakPassage, SystolicPressureError
from heartfit.places.wall import WallPressure

LEAK = Cause("MitralRegurgitation", 8.0, 3e-5, "m^2", (2e-5, 4e-5))
PERIOD = 0.8


@dataclass
class Gained:
    """Stand-in for a held-out prediction with this gain in ln likelihood."""

    gain: float
    by: str

    def helps(self) -> bool:
        return self.gain > 0.0

    def gains(self) -> tuple[str, ...]:
        return (f"gain by {self.by}",)


@dataclass
class Searched:
    """Stand-in for a searched recording of volume and pressure.

    best: the best mechanism on the searched half; factors: ln Bayes factors of mechanisms on all samples.
    """

    searched: tuple[str, ...] = ("lv_volume", "lv_pressure")
    best: str = "Scar"
    factors: Mapping[tuple[str, ...], float] = field(default_factory=dict)
    rules: object = DEFAULT_RULES
    data: None = None
    whole_context: None = None
    explanations: tuple[tuple[str, ...], ...] = (("MitralRegurgitation",),)
    library: Mapping[str, object] = field(
        default_factory=lambda: {
            "MitralRegurgitation": SimpleNamespace(kind=MitralRegurgitation),
            "Scar": SimpleNamespace(kind=Scar),
        }
    )
    model: object = field(default_factory=lambda: SimpleNamespace(simulations=4))
    whole: object = field(default_factory=lambda: SimpleNamespace(model=SimpleNamespace(simulations=13)))

    @property
    def recording(self) -> SimpleNamespace:
        return SimpleNamespace(searched=self.searched)

    @property
    def findings(self) -> SimpleNamespace:
        return SimpleNamespace(
            survey=SimpleNamespace(baseline=None),
            evidences=SimpleNamespace(single=(self.best,)),
            explanation=lambda effects: SimpleNamespace(fit=SimpleNamespace(x=effects[0])),
        )

    def traces(self, explained: SimpleNamespace) -> tuple[str, ...]:
        return (explained.fit.x,)

    def refit(self, effects: tuple[str, ...]) -> SimpleNamespace:
        return SimpleNamespace(log_evidence=self.factors.get(effects, 0.0))

    def cause(self, effects: tuple[str, ...], name: str) -> Cause:
        return replace(LEAK, name=name, ln_bayes_factor=3.0)

    def sizes_from_all_samples(self, named: list[tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
        return tuple(named)


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
    refuted: tuple[str, ...] = (),
    case: Searched | None = None,
    on_half: Mapping[type[Place], float] | None = None,
) -> Diagnosis:
    """Diagnosis with places of these ln Bayes factors on all samples.

    on_half: of the same on the searched half; refuted: names of places and mechanisms that do not help on the other.
    """
    fitted = tuple(place(kind, factor) for kind, factor in places.items())
    half = places if on_half is None else on_half

    def gained(_: object, __: object, x: str, ___: object) -> list[Gained]:
        return [Gained(-1.0 if x in refuted else 2.0, x)]

    search = SimpleNamespace(
        run=lambda _: RankedPlaces(cast("Explanation", SimpleNamespace(log_evidence=0.0)), fitted),
        fitted_from=lambda kind, _: place(kind, half[kind]) if kind in half else None,
    )
    monkeypatch.setattr(module, "PlaceSearch", lambda *_: search)
    monkeypatch.setattr(module, "FitContext", lambda _: None)
    monkeypatch.setattr(module, "predict_extension", gained)
    monkeypatch.setattr(module.ShownPlace, "from_search", shown)
    return locate(before, cast("SearchedRecording", case or Searched()), {}, PLACES)


def regions(diagnosed: Diagnosis) -> list[str]:
    return [one.region for one in diagnosed.acting]


def test_without_a_name_the_best_region_is_where_something_acts(monkeypatch: pytest.MonkeyPatch) -> None:
    diagnosed = located(monkeypatch, diagnosis("none"), {LeakPassage: 12.0, LeakFlow: 9.0, WallPressure: 6.0})
    assert (diagnosed.verdict, regions(diagnosed), diagnosed.simulations) == ("unknown", ["leak"], 17)
    assert diagnosed.acting[0].place == "LeakPassage"
    assert diagnosed.gain == ("gain by LeakPassage",)
    assert diagnosed.alternatives == ()


def test_a_place_takes_that_of_the_candidate(monkeypatch: pytest.MonkeyPatch) -> None:
    """The curves are shown with the function at the place, and one explanation is told."""
    candidate = UnnamedCandidate((LEAK,), BesideProcess(11.2, -131.8, 130.7, 2.0, 4.0))
    before = replace(diagnosis("unknown"), candidate=candidate)
    assert located(monkeypatch, before, {LeakPassage: 12.0}).candidate is None
    assert located(monkeypatch, before, {}).candidate is candidate


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
    diagnosed = located(monkeypatch, diagnosis("none"), {WallPressure: 12.0}, ("WallPressure",))
    assert (diagnosed.verdict, diagnosed.acting, diagnosed.gain) == ("none", (), ())


def test_what_the_searched_half_prefers_predicts_the_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not what all samples prefer: they hold those that judge."""
    places: dict[type[Place], float] = {WallPressure: 12.0, LeakPassage: 7.0}
    half: dict[type[Place], float] = {WallPressure: 1.0, LeakPassage: 2.0}
    diagnosed = located(monkeypatch, diagnosis("none"), places, ("WallPressure",), on_half=half)
    assert regions(diagnosed) == ["wall"]
    assert (diagnosed.gain, diagnosed.traces) == (("gain by LeakPassage",), ("LeakPassage",))
    refuted = located(monkeypatch, diagnosis("none"), places, ("LeakPassage",), on_half=half)
    assert refuted.acting == ()
    assert located(monkeypatch, diagnosis("none"), places, on_half={}).acting == ()


@pytest.mark.parametrize(
    ("best", "factor", "refuted", "verdict"),
    [
        ("MitralRegurgitation", 10.0, (), "named"),
        ("MitralRegurgitation", 8.9, (), "unknown"),
        ("MitralRegurgitation", 10.0, ("MitralRegurgitation",), "unknown"),
        ("Scar", 10.0, (), "unknown"),
    ],
    ids=["as good as the place", "worse than the place", "does not help", "acts elsewhere"],
)
def test_all_samples_confirm_the_best_mechanism_of_the_half(
    monkeypatch: pytest.MonkeyPatch, best: str, factor: float, refuted: tuple[str, ...], verdict: str
) -> None:
    case = Searched(best=best, factors={(best,): factor}, explanations=())
    diagnosed = located(monkeypatch, diagnosis("none"), {LeakPassage: 12.0}, refuted, case)
    assert diagnosed.verdict == verdict
    if verdict == "named":
        assert diagnosed.mechanisms == (replace(LEAK, ln_bayes_factor=factor),)
        assert (diagnosed.gain, diagnosed.acting) == (("gain by MitralRegurgitation",), ())
        assert diagnosed.from_all_samples == (("MitralRegurgitation",),)


@pytest.mark.parametrize(
    ("kind", "factor", "verdict"),
    [(AorticLoss, 9.0, "unknown"), (AorticLoss, 7.0, "named"), (LeakFlow, 30.0, "named")],
    ids=["a stronger place elsewhere", "a weaker place elsewhere", "a place of its own region"],
)
def test_a_name_stands_against_places_of_other_regions(
    monkeypatch: pytest.MonkeyPatch, kind: type[Place], factor: float, verdict: str
) -> None:
    case = Searched(factors={("MitralRegurgitation",): 8.0})
    diagnosed = located(monkeypatch, diagnosis("named", LEAK), {kind: factor}, case=case)
    assert diagnosed.verdict == verdict
    assert diagnosed.withdrawn == (("MitralRegurgitation",) if verdict == "unknown" else ())
    assert diagnosed.mechanisms == (() if verdict == "unknown" else (LEAK,))


def test_a_volume_alone_and_no_places_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    before = diagnosis("none")
    alone = located(monkeypatch, before, {WallPressure: 12.0}, case=Searched(searched=("lv_volume",)))
    assert alone is before
    assert locate(before, cast("SearchedRecording", Searched()), {}, ()) is before
