"""What the report is made from: a study's results as they were read, SI."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from heartfit.calibration.update import Posterior
from heartfit.diagnosis.cause import Diagnosis
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel
from heartfit.tables.card import Card
from heartfit.tables.case import CaseResult

Curves = Mapping[str, Curve]


@dataclass(frozen=True, eq=False)
class Fit:
    """A case under one setting: what was calibrated, and what its simulation gets wrong.

    reference, calibrated: curves of the beats at the prior's mean and at the estimate, none of a beat that failed;
    band: the calibrated beat's standard deviation under the posterior that knows the noise, by curve; motion: the
    calibrated beat's, None if it failed; searched, proved: the diagnoses on the sphere and in three dimensions, None
    where nobody looked.
    """

    result: CaseResult
    card: Card
    reference: Curves
    calibrated: Curves
    band: Curves
    motion: Motion | None
    searched: Diagnosis | None
    proved: Diagnosis | None

    @property
    def posterior(self) -> Posterior:
        """The one that meets the observations."""
        return self.card.met

    @property
    def completed(self) -> bool:
        """Whether the beat at the estimate was simulated to its end."""
        return bool(self.calibrated)

    @property
    def shift(self) -> float:
        """The simulated time, s, of measured time zero, 0 where none was found."""
        return self.result.shift if np.isfinite(self.result.shift) else 0.0


@dataclass(frozen=True, eq=False)
class CaseRecord:
    """One heart: its wall and motion as measured, its curves, and its fits by setting.

    noise: the noise model of its images, or none; still: a picture of the ventricles as a data address, for print.
    """

    name: str
    kind: str
    conduction: str
    mesh: VentricularMesh
    registered: Motion
    measured: Curves
    noise: Sequence[NoiseModel]
    fits: Mapping[str, Fit]
    still: str = ""


@dataclass(frozen=True, eq=False)
class Printed:
    """A table with its title and, below it, why its numbers are not the paper's."""

    title: str
    frame: pd.DataFrame
    note: str


@dataclass(frozen=True)
class Provenance:
    """Where numbers come from: fingerprints and seeds by what they belong to, versions by package, settings as text."""

    fingerprints: Mapping[str, str]
    seeds: Mapping[str, str]
    versions: Mapping[str, str]
    settings: Mapping[str, str]


@dataclass(frozen=True, eq=False)
class StudyRecord:
    """All cases of a study by name, its tables beside the paper's by name, and where they come from."""

    cases: Mapping[str, CaseRecord]
    tables: Mapping[str, Printed]
    provenance: Provenance
    left_out: str = ""
