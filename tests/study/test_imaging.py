"""Configuration of imaging and registration."""

from dataclasses import asdict, fields
from pathlib import Path

import pytest

from heartfit.core.errors import InputError
from heartfit.core.validation import validate
from heartfit.imaging.registration.track import FreeForm
from heartfit.io.configuration import read_configuration, read_study
from heartfit.study.imaging import Acquisition, ImageContrast, PressureLine, Registration, flat
from heartfit.study.study import Study
from heartfit.synthetic.scanner import Catheter, Contrast, Scanner

CONFIG = Path(__file__).parents[2] / "config"


@pytest.fixture(scope="module")
def content():
    return read_configuration([CONFIG / "config.yaml"])


@pytest.mark.parametrize(
    ("table", "record", "kind"),
    [
        (Acquisition(), Acquisition().scanner(), Scanner),
        (PressureLine(), PressureLine().catheter(), Catheter),
        (Registration(), Registration().free_form(), FreeForm),
        (ImageContrast(), Contrast(**ImageContrast().model_dump()), Contrast),
    ],
)
def test_every_option_is_in_the_configuration_with_its_default(table, record, kind):
    assert record == kind()
    assert {field.name for field in fields(kind)} <= set(type(table).model_fields)


def test_other_acquisitions_differ_from_the_cohort_s_in_one_setting():
    study = read_study([CONFIG / "config.yaml"])
    usual = asdict(study.scanner())
    for name, (setting, value) in study.registration_error.acquisitions().items():
        other = asdict(study.scanner(name))
        assert other[setting] == value
        assert {key for key in usual if usual[key] != other[key]} == {setting}
        assert isinstance(other["frames"], int)


@pytest.mark.parametrize(
    ("table", "change", "message"),
    [
        (
            "registration_error",
            {"varied": {"snr": [10]}},
            r"varied\.snr",
        ),
        ("registration_error", {"varied": {"frames": [3]}}, "frames"),
        ("registration_error", {"sequences": 19}, "sequences"),
        ("registration_error", {"varied_sequences": 99}, r"varied_sequences = 99.*sequences"),
        ("registration", {"knot": 1.0}, r"registration\.knot\b.*knots"),
    ],
)
def test_inadmissible_configurations_are_refused_in_one_line(content, table, change, message):
    with pytest.raises(InputError, match=message) as refused:
        validate(Study, content | {table: content[table] | change}, "config")
    assert "\n" not in str(refused.value)


def test_the_protocol_states_every_setting_and_changes_with_each(content):
    study = validate(Study, content, "config")
    other = validate(Study, content | {"registration": content["registration"] | {"reach": 5e-3}}, "config")
    assert len(study.protocol()) == len(flat({"": study.cohort.scanner})) + 3 + len(Registration.model_fields)
    assert set(study.protocol().items()) ^ set(other.protocol().items()) == {
        ("registration.reach", 4e-3),
        ("registration.reach", 5e-3),
    }
