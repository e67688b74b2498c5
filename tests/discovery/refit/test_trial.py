"""Trial of extensions with stand-ins for their refits: what is kept, what is withdrawn, and what is shown."""

from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import CalibrationError
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.prove import ExtensionTrial, FittedExtension
from heartfit.discovery.refit.refit import Refit
from heartfit.discovery.refit.verdict import Proof
from heartfit.discovery.sphere_model.cause import Cause, CurveFit, Diagnosis
from heartfit.personalise.setting import Setting

PLAIN = Setting.model_validate({"element": "sphere", "estimate": ("sigma_0", "R_p")}).with_prior({})
LEAK = Cause("MitralRegurgitation", 20.0, 0.4e-4, "m^2", (0.3e-4, 0.5e-4))
STENOSIS = Cause("AorticStenosis", 24.0, 2e3, "Pa", (1e3, 3e3))
RANKING = {"AorticStenosis": 24.0, "MitralRegurgitation": 20.0}
NAMED = Diagnosis("named", (LEAK,), (), "", (), 100, 0.8, 5.0, RANKING)
TWO = replace(NAMED, verdict="two", mechanisms=(LEAK, STENOSIS))
BEATS = 9
SD = 0.1


def fitted(extension: Extension, evidence: float) -> Refit:
    """A refit that ends with every mechanism at two scales."""
    x = extension.start(2.0)
    covariance = SD**2 * np.eye(x.size)
    known = extension.names, x, covariance, extension.parameters(x), 1.0, 1.0, evidence
    return Refit(*known, 10, BEATS, True, x, covariance, covariance)


@dataclass(frozen=True, eq=False)
class Trial(ExtensionTrial):
    """A trial whose refits have these ln evidences, by the number of mechanisms, and predict unseen data so well."""

    evidences: dict[int, float] = field(default_factory=dict)
    predicts: tuple[int, ...] = ()

    def extended(self, extension: Extension, _: Refit) -> Refit:
        if len(extension.added) not in self.evidences:
            raise CalibrationError("no beat")
        return fitted(extension, self.evidences[len(extension.added)])

    def at(self, extension: Extension, refit: Refit) -> FittedExtension:
        return FittedExtension(extension, refit, cast("Any", None))

    def final(self, fitted: FittedExtension) -> Gaussian | None:
        return Gaussian(fitted.refit.names, fitted.refit.estimate, 0.25 * fitted.refit.covariance)

    def fits(self, _: FittedExtension) -> tuple[CurveFit, ...]:
        """Return no chi-squared: the stand-ins have no curves."""
        return ()

    def proof(self, _: FittedExtension, extended: FittedExtension) -> Proof:
        helps = len(extended.extension.added) in self.predicts
        stand_in = SimpleNamespace(helps=lambda: helps, gains=list, traces=lambda _: ())
        return cast("Proof", stand_in)


def trial(evidences: dict[int, float], predicts: tuple[int, ...]) -> Trial:
    case = cast("Any", SimpleNamespace(both=False))
    nothing = cast("Any", None)
    return Trial(case, nothing, nothing, PLAIN, nothing, nothing, 5, evidences, predicts)


def proved(diagnosis: Diagnosis, judge: Trial) -> tuple[Diagnosis, Refit]:
    return judge.prove(diagnosis, fitted(judge.baseline, 0.0))


@pytest.mark.parametrize(
    ("evidence", "predicts"), [(9.0, ()), (-1.0, (1,))], ids=["predicts-no-better", "is-no-likelier"]
)
def test_a_name_that_does_not_help_is_withdrawn_and_its_trial_is_shown(
    evidence: float, predicts: tuple[int, ...]
) -> None:
    diagnosis, shown = proved(NAMED, trial({1: evidence}, predicts))
    assert (diagnosis.verdict, diagnosis.mechanisms, diagnosis.withdrawn) == ("unknown", (), (LEAK.name,))
    assert diagnosis.refitted is not None
    assert diagnosis.refitted.ln_bayes_factor == evidence
    assert shown.log_evidence == evidence


def test_a_name_that_helps_is_kept_with_the_size_and_interval_of_its_refit() -> None:
    diagnosis, shown = proved(NAMED, trial({1: 9.0}, (1,)))
    scale = 0.15e-4
    assert (diagnosis.verdict, diagnosis.withdrawn) == ("named", ())
    assert diagnosis.mechanisms[0].amplitude == pytest.approx(2.0 * scale)
    assert diagnosis.mechanisms[0].interval == pytest.approx(
        ((2.0 - 1.96 * SD) * scale, (2.0 + 1.96 * SD) * scale)
    )
    assert shown.log_evidence == 9.0
    assert diagnosis.refitted is not None
    (final,) = diagnosis.refitted.from_all_samples
    assert final.interval == pytest.approx(((2.0 - 0.98 * SD) * scale, (2.0 + 0.98 * SD) * scale))


def test_of_two_names_the_second_must_help_beyond_the_first() -> None:
    for judge in (trial({1: 9.0, 2: 12.0}, (1,)), trial({1: 9.0, 2: 8.0}, (1, 2))):
        diagnosis, shown = proved(TWO, judge)
        assert [cause.name for cause in diagnosis.mechanisms] == [STENOSIS.name]
        assert (diagnosis.verdict, diagnosis.withdrawn) == ("named", (LEAK.name,))
        assert shown.log_evidence == 9.0, "the accepted refit is shown, not the last one"
        assert diagnosis.simulations == 100 + 3 * (BEATS + 1)
    both, shown = proved(TWO, trial({1: 9.0, 2: 12.0}, (1, 2)))
    assert (both.verdict, both.withdrawn, shown.log_evidence) == ("two", (), 12.0)


def test_without_a_beat_of_any_extension_nothing_is_proved() -> None:
    diagnosis, shown = proved(NAMED, trial({}, (1,)))
    assert (diagnosis.verdict, diagnosis.refitted, diagnosis.gain) == ("unknown", None, ())
    assert shown.log_evidence == 0.0
