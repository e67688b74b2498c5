"""Sentences and panels about the regions on which something unknown acts."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from heartfit.discovery.sphere_model.cause import (
    ActingPlace,
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
from heartfit.results.verdict_text import verdict_sentence

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
    assert stored.loc["sound", "with a place"].split(" (")[0] in FALSE_PLACES


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
