"""Means of the prior from the beat of the mean healthy adult; writes docs/measured/prior*.tsv, five minutes.

The observations are those of resources/normal_beat.csv with the errors of their means, the heart is the mean adult of
`benchmarks.normal_adults` on the study's virtual mesh. X0 of a setting is the maximum a posteriori about its declared
values, after STEPS unscented steps, in DIGITS digits: what the normal beat does not determine keeps its declared value.
No heart of a cohort enters.
"""

from collections.abc import Mapping
from itertools import islice

import numpy as np
import pandas as pd

from benchmarks.measured_table import store_table
from benchmarks.normal_adults import MEAN_ADULT
from benchmarks.ventricles import ROOT
from heartfit.calibration.alternatives import iterate
from heartfit.calibration.unscented import Forward, Outcome
from heartfit.calibration.update import Posterior
from heartfit.core.parameter import printed_unit, to_printed_unit
from heartfit.geometry.fibres import prepare
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.activation.conduction import assign_activation
from heartfit.io.configuration import read_study
from heartfit.io.tables import read_published
from heartfit.observation.beat import beat_curves
from heartfit.observation.operator import observe
from heartfit.personalise.run import run_beat
from heartfit.personalise.setting import Setting
from heartfit.study.study import Study
from heartfit.synthetic.volunteer import Template

STEPS, DIGITS = 3, 3
SETTINGS = ("physical", "locking")
CONFIG, NORMAL = ROOT / "config" / "config.yaml", ROOT / "resources" / "normal_beat.csv"
EDV = MEAN_ADULT.shape.edv
OBSERVED = {"V_min": EDV, "q_max": EDV, "q_min": EDV, "P_max": 1.0}
"""Observations of the normal beat, and the unit in which they are published [SI]."""
Values = Mapping[str, float]


def main() -> None:
    study = read_study([CONFIG])
    mesh, (observed, errors) = mean_adult(study), normal_beat()
    means = []
    beats = [beat_row("published", "", observed), beat_row("error of the mean", "", errors)]
    for name in SETTINGS:
        setting = declared(study.settings[name])
        forward = forward_of(study, mesh, setting)
        posterior = fitted(setting, forward, observed, errors)
        x0 = rounded(posterior.estimate.physical())
        means += mean_rows(name, setting, posterior, x0)
        points = {"declared": setting.gaussian().physical(), "X0": x0}
        outcomes = forward(list(points.values()))
        beats += [beat_row(name, at, outcome) for at, outcome in zip(points, outcomes, strict=True)]
    store_table("prior", pd.DataFrame(means), "benchmarks.prior")
    store_table("prior_beat", pd.DataFrame(beats), "benchmarks.prior")


def mean_adult(study: Study) -> VentricularMesh:
    """Ventricles of the mean adult at end diastole, activated as healthy ones are."""
    size = study.virtual_mesh
    template = Template.build(size.edge_length, size.tolerance)
    return assign_activation(prepare(template.deformed_to(MEAN_ADULT.shape)))


def normal_beat() -> tuple[dict[str, float], dict[str, float]]:
    """Observations of the normal beat and the errors of their means [SI]; V_min follows from the ejection fraction."""
    table = read_published(NORMAL).set_index("quantity")
    mean, error = (table[column] * table["unit_si"] for column in ("mean", "error"))
    mean["V_min"], error["V_min"] = 1.0 - mean["EF"], error["EF"]
    observed, errors = (
        {name: float(column[name]) * unit for name, unit in OBSERVED.items()} for column in (mean, error)
    )
    return observed, errors


def declared(setting: Setting) -> Setting:
    """The setting with the declared prior instead of the study's."""
    return setting.model_copy(update={"prior": {}}).with_prior({})


def forward_of(study: Study, mesh: VentricularMesh, setting: Setting) -> Forward:
    """Observations of the normal beat from beats of the mean adult."""
    features = study.observation.trial_features(study.observation.frames)

    def outcome(parameters: Values) -> Outcome:
        beat = run_beat(
            mesh, setting, MEAN_ADULT.period, parameters, study.end_diastolic_pressure, study.numerics
        )
        if not beat.completed:
            return beat.reason
        numbers = observe(beat_curves(beat), features)
        return {name: numbers[name] for name in OBSERVED}

    return lambda points: [outcome(point) for point in points]


def fitted(setting: Setting, forward: Forward, observed: Values, errors: Values) -> Posterior:
    """Posterior after the last step."""
    noise = np.diag(np.square([errors[name] for name in observed]))
    *_, last = islice(iterate(setting.gaussian(), forward, observed, noise), STEPS)
    return last


def rounded(values: Values) -> dict[str, float]:
    return {name: float(f"{value:.{DIGITS}g}") for name, value in values.items()}


def mean_rows(name: str, setting: Setting, posterior: Posterior, x0: Values) -> list[dict[str, str]]:
    """A row for each parameter: declared median and deviation, X0, and the deviation that the normal beat leaves."""
    medians, units = setting.gaussian().physical(), setting.units()
    deviations = zip(posterior.prior.sd.tolist(), posterior.estimate.sd.tolist(), strict=True)
    return [
        {
            "setting": name,
            "parameter": parameter,
            "unit": printed_unit(units[parameter]),
            "declared": f"{to_printed_unit(medians[parameter], units[parameter]):g}",
            "X0": f"{to_printed_unit(x0[parameter], units[parameter]):.{DIGITS}g}",
            "declared sd (%)": f"{100 * before:.0f}",
            "sd with the normal beat (%)": f"{100 * after:.0f}",
        }
        for parameter, (before, after) in zip(setting.estimate, deviations, strict=True)
    ]


def beat_row(setting: str, values: str, numbers: Outcome) -> dict[str, str]:
    """Observations of a beat, or their errors, in published units; V_min over EDV is what is not ejected."""
    if isinstance(numbers, str):
        return {"setting": setting, "values": values, "V_min (EDV)": numbers}
    return {
        "setting": setting,
        "values": values,
        "V_min (EDV)": f"{numbers['V_min'] / EDV:.3f}",
        "peak filling rate (EDV/s)": f"{numbers['q_max'] / EDV:.2f}",
        "peak ejection rate (EDV/s)": f"{numbers['q_min'] / EDV:.2f}",
        "P_max (mmHg)": f"{numbers['P_max'] / 133.322:.1f}",
    }


if __name__ == "__main__":
    main()
