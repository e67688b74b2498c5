"""Sentences and panels about the regions on which something unknown acts, and the counts of a benchmark."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from heartfit.discovery.sphere_model.cause import (
    ActingPlace,
    Cause,
    ClearSpan,
    Diagnosis,
    Gain,
    PlaceFunction,
    RankedLaw,
    Trace,
)
from heartfit.io.causes import read_diagnosis, write_cause_card
from heartfit.places import PLACES, REGIONS
from heartfit.results import acting_places
from heartfit.results.acting_places import FALSE_PLACES, acting_section, acting_sentence, law_text, span_text
from heartfit.results.cause_card import gain_subject, markdown_card, next_measurement_text
from heartfit.results.cause_figure import plot_cause, render_cause
from heartfit.results.text import AMPLITUDE_UNITS
from heartfit.results.unknown_places import (
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
from heartfit.results.verdict_text import verdict_sentence
from heartfit.synthetic.campaign import plantable
from heartfit.synthetic.out_of_library import OUT_OF_LIBRARY

MEASURED = Path(__file__).parents[2] / "docs" / "measured"
ORIFICE = RankedLaw("orifice", r"A \sqrt{2 \Delta p / \rho}", 0.27e-4, "m^2", 0.0, {})
PULSE = RankedLaw("pulse", "a", 1.2e-4, "m^3/s", -13.0, {"centre": 0.3, "width": 0.16})
LEAK = ActingPlace(
    "leak", "LeakPassage", "a flow out of the left ventricle", 20.8,
    (ClearSpan(0.23, 0.38, 9.06e-5, 1.1e-5, "m^3/s"),), (ORIFICE, PULSE),
)  # fmt: skip
WALL = ActingPlace("wall", "WallPressure", "a pressure on the wall", 19.0, (), (replace(PULSE, unit="Pa"),))
TIMES = np.linspace(0.0, 0.79, 50)
TRACE = Trace(
    "lv_volume", TIMES, np.full(50, 1e-4), np.full(50, 1.1e-4), np.full(50, 1e-4),
    *(np.full(50, 1e-6) for _ in range(3)),
)  # fmt: skip
FUNCTION = PlaceFunction(
    "leak", "m^3/s", TIMES, 9e-5 * np.sin(TIMES), np.full(50, 1e-5), 9e-5 * np.sin(TIMES)
)


def unknown(*acting: ActingPlace, gain: tuple[Gain, ...] = ()) -> Diagnosis:
    functions = tuple(replace(FUNCTION, region=one.region) for one in acting)
    return Diagnosis(
        "unknown", (), (), "", gain, 10, 0.8, 5.0, {"unknown": 6.0, "Scar": 2.0},
        traces=(TRACE,), acting=acting, functions=functions,
    )  # fmt: skip


def test_one_region_is_told_with_size_times_and_law() -> None:
    assert verdict_sentence(unknown(LEAK)) == (
        "Unknown missing mechanism. If the simulator can be trusted, something that the library lacks acts as a leak "
        "out of the left ventricle: "
        "91 ± 11 mL/s, 230 to 380 ms after the trigger; it follows an orifice law of 0.27 cm²."
    )


def test_regions_that_are_not_told_apart_are_told_together() -> None:
    sentence = acting_sentence((LEAK, WALL))
    assert (
        "as a leak out of the left ventricle or on the wall of the left ventricle; these data do not tell which"
        in sentence
    )


def test_without_a_place_the_verdict_is_unknown_alone() -> None:
    assert verdict_sentence(unknown()).endswith("No mechanism of the library explains the misfit.")


def test_sizes_have_printed_units() -> None:
    assert (
        span_text(ClearSpan(0.1, 0.2, -2000.0, 300.0, "Pa"))
        == "-2 ± 0.3 kPa, 100 to 200 ms after the trigger"
    )
    assert span_text(ClearSpan(0.1, 0.2, 1.23e-4, 9.06e-6, "m^3/s")).startswith("120 ± 9.1 mL/s")
    assert law_text(RankedLaw("gain", "g", -0.05, "1", 0.0, {})) == "a gain law of -0.05"
    assert {place.unit for place in PLACES} <= set(AMPLITUDE_UNITS)


@pytest.mark.parametrize(
    "words", [acting_places.REGIONS, acting_places.EQUIVALENT, acting_places.SEPARATED_BY]
)
def test_every_region_has_its_words(words: dict[str, str]) -> None:
    assert set(words) == set(REGIONS)


def test_the_card_lists_laws_and_the_measurement_that_shows_the_region() -> None:
    section = acting_section((LEAK,), 5.0)
    assert "| orifice | $A \\sqrt{2 \\Delta p / \\rho}$ | 0.27 cm² | 0.0 |" in section
    assert "ln Bayes factor 20.8 (threshold 5)" in section
    assert "Not told apart: where the blood goes" in section
    assert "mitral valve by Doppler" in next_measurement_text(unknown(LEAK))
    assert gain_subject(unknown(LEAK)) == " with a free function at the best place"


def test_a_place_is_told_with_its_false_rates_and_on_a_condition() -> None:
    """The rate of the generator's own sound hearts is that of the stored benchmark."""
    assert FALSE_PLACES in markdown_card(unknown(LEAK), "heart")
    assert FALSE_PLACES not in markdown_card(unknown(), "heart")
    assert "If the simulator can be trusted" in verdict_sentence(unknown(LEAK))
    stored = pd.read_csv(MEASURED / "unknown_places.tsv", sep="\t", comment="#").set_index("hearts")
    assert stored.loc[SOUND, "with a place"].split(" (")[0] in FALSE_PLACES


def test_the_figure_has_a_panel_for_each_function() -> None:
    assert len(plot_cause(unknown(LEAK, WALL)).axes) == len(plot_cause(unknown()).axes) + 2
    figure = plot_cause(unknown(LEAK))
    labels = {line.get_label() for axes in figure.axes for line in axes.lines}
    assert {"sphere, no mechanism", "with a free function at the best place"} <= labels
    panel = figure.axes[0]
    assert panel.get_title() == "acts as a leak out of the left ventricle"
    assert panel.lines[1].get_ydata() == pytest.approx(1e6 * FUNCTION.mean)
    assert panel.lines[2].get_ydata() == pytest.approx(1e6 * FUNCTION.law)


def test_a_written_card_restores_the_places(tmp_path) -> None:  # type: ignore[no-untyped-def]
    rendered = render_cause(unknown(LEAK, WALL), "patient")
    write_cause_card(tmp_path, rendered, "code")
    restored = read_diagnosis(tmp_path)
    assert restored.acting == (LEAK, WALL)
    assert [one.region for one in restored.functions] == ["leak", "wall"]
    assert restored.functions[0].mean == pytest.approx(FUNCTION.mean)


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
