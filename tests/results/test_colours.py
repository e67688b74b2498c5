"""A setting has one colour, which follows from its place in the study, whatever settings a case has."""

from base64 import b64decode
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
import yaml

from heartfit.geometry.mesh import VentricularMesh
from heartfit.results.colours import SETTING_COLOURS, setting_colours
from heartfit.results.figures import ARTERY, CALIBRATED, MEASURED, REFERENCE
from heartfit.results.report.cases import plot_cohort
from heartfit.results.report.curves import plot_curves, simulated
from heartfit.results.report.parameters import plot_estimates, plot_parameters
from heartfit.results.report.picture import Picture
from heartfit.results.report.record import CaseRecord
from tests.results.report.small_report import SETTING, study

CONFIGURATIONS = Path(__file__).parents[2] / "config"
COLOURS = setting_colours(["locking", SETTING])


@pytest.fixture(scope="module")
def cases(ventricle: VentricularMesh) -> list[CaseRecord]:
    """A heart under both settings, then one under the second alone."""
    both, second = study(ventricle).cases.values()
    completed = both.fits[SETTING]
    fits = {"locking": completed, SETTING: completed}
    return [replace(both, fits=fits), replace(second, fits={SETTING: completed})]


def test_no_two_settings_and_no_other_meaning_share_a_colour() -> None:
    taken = Counter([*SETTING_COLOURS, MEASURED, REFERENCE, ARTERY, CALIBRATED])
    assert set(taken.values()) == {1}


def test_a_colour_follows_from_the_place_among_all_settings() -> None:
    assert setting_colours(["b", "a"]) == {"b": SETTING_COLOURS[0], "a": SETTING_COLOURS[1]}


@pytest.mark.parametrize("file", sorted(CONFIGURATIONS.glob("*.yaml")), ids=lambda file: file.stem)
def test_there_are_colours_for_all_settings_of_a_shipped_study(file: Path) -> None:
    settings = yaml.safe_load(file.read_text()).get("settings", {})
    assert len({"locking", "physical", *settings}) <= len(SETTING_COLOURS)


def test_every_beat_has_the_colour_of_its_setting(cases: list[CaseRecord]) -> None:
    for case in cases:
        shown = {label: shade for label, _, _, shade, _ in simulated(case, COLOURS)}
        assert shown == {"prior mean": REFERENCE} | {
            f"calibrated, {setting}": COLOURS[setting] for setting in case.fits
        }


def test_the_pictures_of_the_report_use_the_colours_of_their_settings(cases: list[CaseRecord]) -> None:
    first, second = (COLOURS[setting].lower() for setting in ("locking", SETTING))
    both, one = cases
    assert settings_in(plot_cohort(cases, COLOURS)) == {first, second}
    assert settings_in(plot_cohort([one], COLOURS)) == {second}
    assert settings_in(plot_curves(both, COLOURS)) == {first, second}
    assert settings_in(plot_curves(one, COLOURS)) == {second}
    assert settings_in(plot_estimates(one, cases, COLOURS)) == {second}
    assert settings_in(plot_parameters(cases, "locking", COLOURS["locking"])) == {first}


def settings_in(picture: Picture) -> set[str]:
    """Colours of settings in a picture."""
    drawn = b64decode(picture.address.partition(",")[2]).decode()
    return {colour.lower() for colour in SETTING_COLOURS if colour.lower() in drawn}
