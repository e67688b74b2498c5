r"""Records of the report: results of a study, SI units, and the posterior band of the calibrated curves.

.. math:: V(t) = S(t)^T C_{post} S(t), \qquad S(t) = C^{-1} Cov(X, y(t))

Cov(X, y(t)) over the sigma points is that of the unscented transform of a whole curve instead of the observations; C
is the prior covariance and C_post the posterior covariance of the logarithms.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Self

import numpy as np
import pandas as pd
from PIL import Image

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import CalibrationError, SigmaPoint, transform
from heartfit.calibration.update import Posterior
from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel
from heartfit.results.card import Card, comparable_truth
from heartfit.results.case import CaseResult
from heartfit.results.colours import setting_colours
from heartfit.results.discovery import DiscoveryResult
from heartfit.results.text import NOTES, STATED_ONCE, without_repeats
from heartfit.results.wall_summary import WallSummary
from heartfit.study.case import Kind

Curves = Mapping[str, Curve]


def curve_deviation(
    prior: Gaussian,
    points: Sequence[SigmaPoint],
    beats: Sequence[Curves],
    estimate: Gaussian,
    around: Curves,
) -> dict[str, Curve]:
    """Return the standard deviation of each volume and pressure of ``around``, SI; empty if too many points failed.

    beats: curves of each sigma point, empty for a failed beat.
    """
    completed = np.array([bool(beat) for beat in beats])
    deviations = {}
    for name in [curve for curve in around if curve.endswith(("_volume", "_pressure"))]:
        times = around[name].times
        values = np.array([beat[name](times) if beat else np.zeros(len(times)) for beat in beats])
        try:
            moments = transform(points, values, completed=completed)
        except CalibrationError:
            return {}
        slopes = np.linalg.solve(prior.covariance, moments.cov_xz)
        sd = np.sqrt(np.einsum("it,ij,jt->t", slopes, estimate.covariance, slopes))
        deviations[name] = Curve(times, sd, around[name].period)
    return deviations


TITLES = {
    "claims": "Every number that the paper states, and ours",
    "table1_as_printed": "Table 1 as printed, and ours in its layout",
    "table2_as_printed": "Table 2 as printed, and ours in its layout",
    "table1": "Errors of the healthy hearts (the paper's Table 1)",
    "table2": "Parameters of the healthy hearts (the paper's Table 2)",
    "table3": "Errors of the patients (the paper's Table 3)",
    "table3_parameters": "Parameters of the patients over the healthy mean (the paper's Table 3)",
    "plausibility": "Plausibility outside the observations",
    "costs": "Computing time and memory",
}


PAPER_TABLES = tuple(name for name in TITLES if name not in ("plausibility", "costs"))
"""Tables that compare with the paper."""

TABLES_OF_TEXT = ("claims", "table1_as_printed", "table2_as_printed")
"""Tables whose cells are rounded as printed, and read as text."""


@dataclass(frozen=True, eq=False)
class SigmaBeats:
    """Sigma points and the Gaussian that they represent, with the curves of their beats, empty for a failed beat."""

    around: Gaussian
    points: Sequence[SigmaPoint]
    beats: Sequence[Curves]


@dataclass(frozen=True, eq=False)
class FittedCase:
    """A case under one setting: its calibration and its diagnoses.

    reference, calibrated: curves of the beats at the prior mean and at the estimate, empty for a failed beat; band:
    standard deviation of the calibrated beat under the noise-aware posterior, by curve; motion: of the calibrated
    beat, None if it failed; searched, proved: diagnoses on the sphere and in three dimensions, None without a search.
    """

    result: CaseResult
    card: Card
    reference: Curves
    calibrated: Curves
    band: Curves
    motion: Motion | None
    searched: Diagnosis | None
    proved: Diagnosis | None

    @classmethod
    def of(
        cls,
        result: CaseResult,
        posteriors: tuple[Posterior, Posterior],
        truth: Mapping[str, float],
        sigma: SigmaBeats,
        reference: Curves,
        calibrated: Curves,
        motion: Motion | None,
        diagnoses: tuple[Diagnosis | None, Diagnosis | None],
    ) -> Self:
        """Return the fit of these results; posteriors: noise-free and noise-aware; truth: SI by name."""
        noise_free, noise_aware = posteriors
        card = Card(result.case, result.setting, noise_free, noise_aware, comparable_truth(truth))
        sd = curve_deviation(sigma.around, sigma.points, sigma.beats, noise_aware.estimate, calibrated)
        return cls(result, card, reference, calibrated, sd, motion, *diagnoses)

    @property
    def posterior(self) -> Posterior:
        """Return the noise-free posterior."""
        return self.card.noise_free

    @property
    def completed(self) -> bool:
        """Return if the beat at the estimate was simulated to its end."""
        return bool(self.calibrated)

    @property
    def shift(self) -> float:
        """Return the simulated time of measured time zero [s], 0 without a fitted shift."""
        return self.result.shift if np.isfinite(self.result.shift) else 0.0


@dataclass(frozen=True, eq=False)
class CaseRecord:
    """One heart: wall and motion as measured, curves, and fits by setting.

    noise: noise model of its images, or empty; still: picture of the ventricles for print, or None; walls: searches
    with the strain of its wall, by setting.
    """

    name: str
    kind: Kind
    conduction: str
    mesh: VentricularMesh
    registered: Motion
    measured: Curves
    noise: Sequence[NoiseModel]
    fits: Mapping[str, FittedCase]
    still: Image.Image | None = None
    walls: Mapping[str, WallSummary] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class ReportTable:
    """A table with its title, and a note below it on differences from the paper.

    A cell of text is printed as it is, a number to the digits of all tables.
    """

    title: str
    frame: pd.DataFrame
    note: str

    @classmethod
    def of(cls, name: str, frame: pd.DataFrame) -> Self:
        """Return the table of this name, one of ``TITLES``."""
        shown = without_repeats(frame, STATED_ONCE.get(name, ()))
        return cls(TITLES[name], shown if name in TABLES_OF_TEXT else frame.map(_number), NOTES.get(name, ""))


DECIMAL = re.compile(r"-?\d+\.\d+")


def _number(cell: object) -> object:
    """Return a number from a cell of a column that also holds words."""
    return float(cell) if isinstance(cell, str) and DECIMAL.fullmatch(cell) else cell


@dataclass(frozen=True)
class Provenance:
    """Fingerprints and seeds by owner, versions by package, settings as text."""

    fingerprints: Mapping[str, str]
    seeds: Mapping[str, str]
    versions: Mapping[str, str]
    settings: Mapping[str, str]


@dataclass(frozen=True, eq=False)
class StudyRecord:
    """All cases of a study by name, its tables by name, and their provenance.

    settings: all of the study, also those that no case has; discoveries: of the refitted cases, with the answers of
    sealed ones.
    """

    cases: Mapping[str, CaseRecord]
    settings: Sequence[str]
    tables: Mapping[str, ReportTable]
    provenance: Provenance
    left_out: str = ""
    discoveries: Sequence[DiscoveryResult] = ()

    @property
    def of_paper(self) -> bool:
        """Return if it has the paper's virtual volunteers, with which its tables compare."""
        return any(case.kind == "virtual" for case in self.cases.values())

    @property
    def colours(self) -> Mapping[str, str]:
        """Return the colour of each setting."""
        return setting_colours(self.settings)
