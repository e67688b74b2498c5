"""Regions and laws that diagnoses give unknown effects, counted by the kind of heart."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from heartfit.discovery.sphere_model.cause import ActingPlace, Diagnosis
from heartfit.discovery.sphere_model.unknown_place import LEAD
from heartfit.observation.noise_model import Share
from heartfit.places import PLACES, Place, Region, regions_of
from heartfit.places.place import FunctionOfTime
from heartfit.results.text import AMPLITUDE_UNITS, spaced_name
from heartfit.roles import registered
from heartfit.synthetic.out_of_library import OUT_OF_LIBRARY

SOUND, OUTSIDE, REMOVED, COMPLETE = "sound", "outside the library", "entry removed", "complete library"
REGION_OF_TWITCH: Region = "muscle"
TRUE_LAWS: Mapping[str, str] = {
    "SeptalDefect": "orifice",
    "MitralRegurgitation": "orifice",
    "AorticRegurgitation": "orifice",
    "MitralStenosis": "loss",
    "AorticStenosis": "loss",
    "CurvedVolume": "bow",
    "ImageShrinkage": "gain",
    "ImageTriggerDelay": "delay",
    "CatheterWhip": "ringing",
    "CatheterOffset": "offset",
    "CatheterDelay": "delay",
    "ThoracicPulse": "pulse",
    "SeptalLoad": "pulse",
    "AtrialSurge": "pulse",
    "ArterialReflection": "pulse",
    "SecondTwitch": "pulse",
    "Obliteration": "obliteration",
    "Pericardium": "stiffening",
}
"""The law of the region that an effect follows, by its name; of the others none of the laws is the right one."""


@dataclass(frozen=True, eq=False)
class PlaceTrial:
    """A hidden effect, empty in a sound heart, and the diagnoses before and after the search for places.

    raised: the diagnosis of a heart with a place that must also help with raised legs; None where it was not asked.
    """

    seed: int
    group: str
    effect: str
    scales: float
    before: Diagnosis
    after: Diagnosis
    raised: Diagnosis | None = None

    @property
    def regions(self) -> frozenset[Region]:
        """Regions on which the effect acts."""
        kinds = {**registered(), **{kind.__name__: kind for kind in OUT_OF_LIBRARY}}
        if self.effect == "SecondTwitch":
            return frozenset({REGION_OF_TWITCH})
        return regions_of(kinds[self.effect]) if self.effect else frozenset()

    @property
    def acting(self) -> tuple[ActingPlace, ...]:
        """Regions that the verdict names, the best first."""
        return self.after.acting

    @property
    def right_first(self) -> bool:
        """True if the best region is a right one."""
        return bool(self.acting) and self.acting[0].region in self.regions

    @property
    def right_within(self) -> bool:
        """True if a right region is among those that are not told from the best."""
        return any(one.region in self.regions for one in self.acting)

    @property
    def named_there(self) -> bool:
        """True if a mechanism is named that acts on a right region."""
        return any(regions_of(registered()[cause.name]) & self.regions for cause in self.after.mechanisms)

    @property
    def named_elsewhere(self) -> bool:
        """True if mechanisms are named of which none acts on a right region; in a sound heart, if any is."""
        return bool(self.after.mechanisms) and not self.named_there

    @property
    def law_difference(self) -> float:
        """ln likelihood of the right law beside the best, in the best region; NaN without a right region or law."""
        if not self.right_first or self.effect not in TRUE_LAWS:
            return np.nan
        return next(law.ln_likelihood for law in self.acting[0].laws if law.name == TRUE_LAWS[self.effect])

    def gain(self, curve: str) -> float:
        """Error ratio of a curve on the held-out half, with the function at the best place; NaN without a place."""
        gains = {gain.curve: gain.ratio for gain in self.after.gain} if self.acting else {}
        return gains.get(curve, np.nan)


def forms_table() -> pd.DataFrame:
    """Return a row for every place: its region, slot, argument, and the amplitude of its prior."""
    return pd.DataFrame([_form(place) for place in PLACES])


def _form(place: type[Place]) -> dict[str, object]:
    unit, factor = AMPLITUDE_UNITS[place.unit]
    argument = "size" if place.one_sided else "time" if issubclass(place, FunctionOfTime) else "state"
    return {
        "place": spaced_name(place.__name__),
        "region": place.region,
        "acts on": place.slot,
        "function of": argument,
        "coefficients": place.size,
        "amplitude": f"{factor * place.amplitude:.3g} {unit}".strip(),
    }


def places_table(trials: Sequence[PlaceTrial]) -> pd.DataFrame:
    """Return regions, laws and held-out error ratios of all kinds of hearts with an unknown effect, and sound ones."""
    groups: dict[tuple[str, str], list[PlaceTrial]] = {}
    for trial in trials:
        if trial.group != COMPLETE:
            groups.setdefault((trial.group, f"{trial.scales:g}" if trial.effect else ""), []).append(trial)
    hidden = [trial for trial in trials if trial.group in (OUTSIDE, REMOVED)]
    rows = [_places(group, scales, some) for (group, scales), some in sorted(groups.items())]
    return pd.DataFrame([*rows, _places("all hidden", "", hidden)])


def _places(group: str, scales: str, trials: Sequence[PlaceTrial]) -> dict[str, object]:
    detected = [trial for trial in trials if trial.acting]
    leading = [trial for trial in detected if len(trial.acting) == 1]
    laws = np.array([trial.law_difference for trial in detected])
    known = laws[np.isfinite(laws)]
    raised = [trial.raised for trial in detected if trial.raised]
    return {
        "hearts": group,
        "scales": scales,
        "number": len(trials),
        "with a place": _share(len(detected), len(trials)),
        "right region first": _share(sum(trial.right_first for trial in detected), len(detected)),
        f"within {LEAD:g}": _share(sum(trial.right_within for trial in detected), len(detected)),
        "leads and is right": _share(sum(trial.right_first for trial in leading), len(leading)),
        "right law first": _share(int((known == 0.0).sum()), known.size),
        f"law within {LEAD:g}": _share(int((known > -LEAD).sum()), known.size),
        "held-out volume": _median(trial.gain("lv_volume") for trial in detected),
        "held-out pressure": _median(trial.gain("lv_pressure") for trial in detected),
        "helps with raised legs": _share(sum(bool(one.acting) for one in raised), len(raised)),
        "named there": _share(sum(trial.named_there for trial in trials), len(trials)),
        "named elsewhere": _share(sum(trial.named_elsewhere for trial in trials), len(trials)),
    }


AIMED_AT = {
    "right region first": 80.0,
    f"within {LEAD:g}": 92.0,
    "leads and is right": 93.0,
    "right law first": 70.0,
    f"law within {LEAD:g}": 90.0,
    "helps with raised legs": 80.0,
}
"""Least shares [%] of the hidden effects with a place, by column of the table of places."""
AIMED_DETECTED, AIMED_SOUND, AIMED_PRESSURE = 55.0, 4.0, 0.80
"""Least share of effects of 3 scales with a place [%], largest share of sound hearts with one [%], and largest median
ratio of the held-out error of the pressure."""


def targets_table(places: pd.DataFrame) -> pd.DataFrame:
    """Return what was aimed at beside what the table of places holds."""
    hidden, sound = (
        places[places["hearts"] == "all hidden"].iloc[0],
        places[places["hearts"] == SOUND].iloc[0],
    )
    three = places[places["scales"].astype(str) == "3"]
    detected, named = (
        sum(_count(share)[0] for share in three[column]) for column in ("with a place", "named there")
    )
    of = int(three["number"].sum())
    rows = [
        _target("controls with a place", _count(sound["with a place"]), AIMED_SOUND, least=False),
        *(_target(name, _count(hidden[name]), share) for name, share in AIMED_AT.items()),
        _target("with a place at 3 scales", (detected, of), AIMED_DETECTED),
        _target("with a place or named in its region at 3 scales", (detected + named, of), AIMED_DETECTED),
    ]
    ratio = float(hidden["held-out pressure"])
    met = "met" if ratio <= AIMED_PRESSURE else "**missed**"
    pressure = ("held-out pressure, median ratio", f"at most {AIMED_PRESSURE:.2f}", f"{ratio:.2f}", met)
    return pd.DataFrame([*rows, pressure], columns=["quantity", "aimed at", "measured", "met"])


def _count(share: str) -> tuple[int, int]:
    """Return the numbers of "12 of 20 (36 to 81 %)"."""
    count, _, of, *_ = share.split()
    return int(count), int(of)


def _target(name: str, counted: tuple[int, int], aimed: float, least: bool = True) -> tuple[str, ...]:
    count, of = counted
    share = 100.0 * count / of
    met = share >= aimed if least else share <= aimed
    words = f"{'at least' if least else 'at most'} {aimed:g} %"
    return name, words, f"{share:.0f} % ({count} of {of})", "met" if met else "**missed**"


def _share(count: int, of: int) -> str:
    """Return "12 of 20 (36 to 81 %)" with the exact 95 % interval."""
    if not of:
        return "–"
    share = Share.from_count(count, of)
    return f"{count} of {of} ({100.0 * share.low:.0f} to {100.0 * share.high:.0f} %)"


def _median(values: Iterable[float]) -> str:
    finite = [value for value in values if np.isfinite(value)]
    return f"{np.median(finite):.2f}" if finite else "–"


def names_table(trials: Sequence[PlaceTrial]) -> pd.DataFrame:
    """Return how often the complete library names the hidden mechanism, without and with places beside it."""
    complete = [trial for trial in trials if trial.group == COMPLETE]
    sides: Mapping[str, Callable[[PlaceTrial], Diagnosis]] = {
        "library alone": lambda trial: trial.before,
        "library and places": lambda trial: trial.after,
    }
    return pd.DataFrame(
        [
            {
                "search": name,
                "hearts": len(complete),
                "right": sum(_right(side(trial), trial.effect) for trial in complete),
                "wrong": sum(_wrong(side(trial), trial.effect) for trial in complete),
                "unknown": sum(side(trial).verdict == "unknown" for trial in complete),
                "nothing": sum(
                    side(trial).verdict in ("none", "model", "insufficient") for trial in complete
                ),
            }
            for name, side in sides.items()
        ]
    )


def _names(diagnosis: Diagnosis) -> set[str]:
    return {cause.name for cause in diagnosis.mechanisms}


def _right(diagnosis: Diagnosis, effect: str) -> bool:
    return effect in _names(diagnosis)


def _wrong(diagnosis: Diagnosis, effect: str) -> bool:
    return bool(_names(diagnosis)) and effect not in _names(diagnosis)


def hearts_table(trials: Sequence[PlaceTrial]) -> pd.DataFrame:
    """Return a row for every heart."""
    return pd.DataFrame([_heart(trial) for trial in trials])


def _heart(trial: PlaceTrial) -> dict[str, object]:
    acting = ", ".join(f"{one.region} {one.ln_bayes_factor:.1f}" for one in trial.acting)
    laws = (
        ", ".join(f"{law.name} {law.ln_likelihood:.1f}" for law in trial.acting[0].laws[:2]) if acting else ""
    )
    return {
        "seed": trial.seed,
        "hearts": trial.group,
        "effect": spaced_name(trial.effect) if trial.effect else "none",
        "scales": f"{trial.scales:g}" if trial.effect else "",
        "acts on": ", ".join(sorted(trial.regions)),
        "library alone": _verdict(trial.before),
        "with places": _verdict(trial.after),
        "places": acting,
        "laws": laws,
    }


def _verdict(diagnosis: Diagnosis) -> str:
    names = ", ".join(spaced_name(name) for name in sorted(_names(diagnosis)))
    return names or f"`{diagnosis.verdict}`"
