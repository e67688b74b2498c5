"""Counts of regions, laws and names of the benchmark of places."""

from dataclasses import replace

import pandas as pd

from benchmarks.place_tables import (
    COMPLETE,
    OUTSIDE,
    REMOVED,
    SOUND,
    TRUE_LAWS,
    PlaceTrial,
    forms_table,
    hearts_table,
    names_table,
    places_table,
    targets_table,
)
from heartfit.discovery.sphere_model.cause import ActingPlace, Cause, Diagnosis, Gain, RankedLaw
from heartfit.places import PLACES
from heartfit.synthetic.campaign import plantable
from heartfit.synthetic.out_of_library import OUT_OF_LIBRARY

ORIFICE, PULSE = (
    RankedLaw("orifice", "", 0.27e-4, "m^2", 0.0, {}),
    RankedLaw("pulse", "", 1.2e-4, "m^3/s", -13.0, {}),
)
LEAK = ActingPlace("leak", "LeakPassage", "a flow out of the left ventricle", 20.8, (), (ORIFICE, PULSE))
WALL = ActingPlace("wall", "WallPressure", "a pressure on the wall", 19.0, (), (replace(PULSE, unit="Pa"),))


def unknown(*acting: ActingPlace, gain: tuple[Gain, ...] = ()) -> Diagnosis:
    return Diagnosis("unknown", (), (), "", gain, 10, 0.8, 5.0, acting=acting)


NOTHING = Diagnosis("none", (), (), "", (), 10, 0.8, 5.0)
NAMED = replace(NOTHING, verdict="named", mechanisms=(Cause("AorticStenosis", 8.0, 1.0, "1", (0.5, 1.5)),))
GAINS = tuple(
    Gain(curve, "half", 2.0, 1.0, ratio, (0.4, 0.6))
    for curve, ratio in (("lv_volume", 0.5), ("lv_pressure", 0.8))
)
TRIALS = (
    PlaceTrial(1, SOUND, "", 0.0, NOTHING, NOTHING),
    PlaceTrial(2, SOUND, "", 0.0, NOTHING, unknown(WALL)),
    PlaceTrial(3, OUTSIDE, "SeptalDefect", 3.0, NOTHING, unknown(LEAK, gain=GAINS)),
    PlaceTrial(4, OUTSIDE, "SecondTwitch", 3.0, NOTHING, unknown(WALL)),
    PlaceTrial(5, REMOVED, "MitralRegurgitation", 3.0, NOTHING, unknown(WALL, LEAK)),
    PlaceTrial(6, REMOVED, "AorticStenosis", 3.0, NOTHING, NOTHING),
    PlaceTrial(7, COMPLETE, "AorticStenosis", 3.0, NAMED, unknown(LEAK)),
    PlaceTrial(8, COMPLETE, "MitralStenosis", 3.0, NAMED, NAMED),
)  # fmt: skip


def test_regions_and_laws_are_counted_by_kind_of_heart() -> None:
    table = places_table(TRIALS).set_index("hearts")
    assert table.loc[SOUND, "with a place"].startswith("1 of 2")
    assert table.loc["all hidden", "with a place"].startswith("3 of 4")
    assert table.loc["all hidden", "right region first"].startswith("1 of 3")
    assert table.loc["all hidden", "within 3"].startswith("2 of 3")
    assert table.loc["all hidden", "leads and is right"].startswith("1 of 2")
    assert table.loc["all hidden", "right law first"].startswith("1 of 1")
    assert table.loc[OUTSIDE, "held-out volume"] == "0.50"
    assert COMPLETE not in table.index


def test_names_are_counted_without_and_with_places() -> None:
    alone, beside = (row for _, row in names_table(TRIALS).iterrows())
    assert (alone["right"], alone["wrong"], alone["unknown"]) == (1, 1, 0)
    assert (beside["right"], beside["wrong"], beside["unknown"]) == (0, 1, 1)


def test_every_heart_has_a_row() -> None:
    table = hearts_table(TRIALS)
    assert len(table) == len(TRIALS)
    assert table.loc[2, "places"] == "leak 20.8"
    assert table.loc[2, "laws"] == "orifice 0.0, pulse -13.0"
    assert table.loc[7, "with places"] == "aortic stenosis"


def test_true_laws_belong_to_effects_that_can_be_planted() -> None:
    names = {*plantable(), *(kind.__name__ for kind in OUT_OF_LIBRARY)}
    assert set(TRUE_LAWS) <= names
    assert len(forms_table()) == len(PLACES)


def test_targets_stand_beside_what_was_measured() -> None:
    share = {"with a place": "11 of 26 (23 to 63 %)", "right region first": "8 of 11 (39 to 94 %)"}
    rest = dict.fromkeys(
        ("within 3", "leads and is right", "right law first", "law within 3"), "9 of 10 (0 to 1 %)"
    )
    row = {
        "scales": "3",
        "number": 26,
        **share,
        **rest,
        "named there": "4 of 26 (0 to 1 %)",
        "helps with raised legs": "8 of 10 (0 to 1 %)",
        "held-out pressure": "0.81",
    }
    sound = row | {"hearts": SOUND, "scales": "", "with a place": "1 of 40 (0 to 13 %)"}
    places = pd.DataFrame(
        [
            row | {"hearts": REMOVED},
            row | {"hearts": OUTSIDE},
            sound,
            row | {"hearts": "all hidden", "scales": ""},
        ]
    )
    targets = targets_table(places).set_index("quantity")
    assert targets.loc["controls with a place"].tolist() == ["at most 4 %", "2 % (1 of 40)", "met"]
    assert targets.loc["right region first"].tolist() == ["at least 80 %", "73 % (8 of 11)", "**missed**"]
    assert targets.loc["with a place at 3 scales", "measured"] == "42 % (22 of 52)"
    assert targets.loc["with a place or named in its region at 3 scales", "measured"] == "58 % (30 of 52)"
    assert targets.loc["helps with raised legs", "met"] == "met"
    assert targets.loc["held-out pressure, median ratio", "met"] == "**missed**"
