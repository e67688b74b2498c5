"""A recording as a problem of inference, and a search within the structure of other simulators."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.discovery.inference.decide import DEFAULT_RULES
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS
from heartfit.discovery.sphere_model.landmarks import PHASES
from heartfit.discovery.sphere_model.nominal_heart import ADULT, PEOPLE, perturb
from heartfit.discovery.sphere_model.problem import SphereProblem
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.structure import Structure, healthy_residual, learn_from_controls
from heartfit.io.structure import read_residuals
from tests.discovery.sphere_model.hearts import LEAK, healthy, recorded

STRUCTURE = Structure.from_residuals(read_residuals())


def test_a_heart_that_stands_for_people_varies_as_they_do() -> None:
    at = np.zeros(len(FREE_PARAMETERS))
    at[-1] = -2.0
    trigger = {heart: perturb(heart, at).heart.tissue.control.trigger_delay for heart in (ADULT, PEOPLE)}
    assert trigger[ADULT] == pytest.approx(0.045 - 2.0 * 0.020)
    assert trigger[PEOPLE] == pytest.approx(0.015 - 2.0 * 0.025), "an R wave before the earliest activation"
    changed = perturb(replace(PEOPLE, stands_for="change"), at).heart.tissue.control.trigger_delay
    assert changed == pytest.approx(0.015 - 2.0 * 0.020)


def test_an_r_wave_before_the_activation_is_fitted() -> None:
    """A recording that begins 40 ms before the earliest activation is 85 ms late about the adult."""
    recording = healthy(4)
    curves = {
        name: replace(samples, times=samples.times + 0.055) for name, samples in recording.curves.items()
    }
    problem = SphereProblem.from_recording(replace(recording, curves=curves), PEOPLE.scaled_to(recording))
    fitted = problem.fit().fit
    heart = perturb(problem.model.nominal, fitted.x).heart
    assert heart.tissue.control.trigger_delay < 0.0
    pressure = problem.data.rows[1]
    left = (problem.data.values - fitted.predicted)[pressure]
    assert np.sqrt(np.mean(left**2)) < 500.0


def test_the_structural_covariance_has_the_units_of_the_curves() -> None:
    problem = SphereProblem.from_recording(healthy(4), structure=STRUCTURE)
    assert problem.data.structure is not None
    sd = np.sqrt(np.diag(problem.data.structure))
    volume, pressure = (sd[rows].mean() for rows in problem.data.rows)
    assert 2e-6 < volume < 30e-6
    assert 50.0 < pressure < 1000.0
    assert problem.model.nominal.stands_for == "people"


def test_a_volume_alone_takes_its_landmarks_from_the_fitted_beat() -> None:
    both = healthy(4)
    alone = replace(both, curves={"lv_volume": both.curves["lv_volume"]})
    expected = SphereProblem.from_recording(both).frame.landmarks
    marks = SphereProblem.from_recording(alone).frame.landmarks
    assert marks.rise == pytest.approx(expected.rise, abs=0.04)
    assert marks.fall == pytest.approx(expected.fall, abs=0.06)


@pytest.mark.usefixtures("few_mechanisms")
def test_a_leak_in_a_heart_of_our_law_is_named_within_the_structure_of_others() -> None:
    """A heart of our law needs none of that structure, beside which a name would need 25."""
    diagnosis = diagnose(recorded(replace(LEAK, scales=2.0)), structure=STRUCTURE)
    first, second = list(diagnosis.ranking.items())[:2]
    assert first[0] == "MitralRegurgitation"
    assert first[1] > second[1] + 5.0
    assert diagnosis.verdict == "named"
    assert diagnosis.threshold == DEFAULT_RULES.detected
    assert all(trace.structure is not None for trace in diagnosis.traces)


def test_beside_structure_more_is_needed() -> None:
    assert DEFAULT_RULES.beside_structure(0.0) == DEFAULT_RULES
    raised = DEFAULT_RULES.beside_structure(0.5)
    assert raised.detected == DEFAULT_RULES.detected_beside_structure
    assert raised.suspected - raised.detected == DEFAULT_RULES.suspected - DEFAULT_RULES.detected


def test_what_our_law_leaves_of_its_own_hearts_is_little() -> None:
    residual = healthy_residual(healthy(4))
    assert residual.shape == (2 * PHASES,)
    assert np.sqrt(np.mean(residual[:PHASES] ** 2)) < 0.03
    assert np.sqrt(np.mean(residual[PHASES:] ** 2)) < 0.03


def test_a_control_without_pressure_is_refused_by_name() -> None:
    whole = healthy(4)
    alone = Recording(whole.period, {"lv_volume": whole.curves["lv_volume"]})
    with pytest.raises(
        InputError, match=r"third\.csv: reference: no lv_pressure; expected volume and pressure"
    ):
        learn_from_controls({"third.csv": alone})
