r"""Measured curves of a whole heart, with the strain of its wall, as the data of a search in three dimensions.

Volumes and pressures have the noise of the search on the sphere. The regional curves are those of a registered motion,
over the mean gain of their kind; the noise of that registration ties them together,

.. math:: \mathrm{Cov}(y) = R + c^2\, \Sigma(e), \qquad c \in \{0.7, 1, 1.5\},

with R the roughness of any simulation and Sigma that of :mod:`heartfit.observation.regional_noise` at the measured
strain, held while models are fitted. As on the sphere the right volume has a gain of its own; since the mesh has the
volume of the first frame, it acts on the change from there and adds
:math:`c^2\, 0.1^2\, (V_i - V_0)(V_j - V_0)`. Strain of the apical segments, which registration does not follow, and
longitudinal strain, whose noise is as large as what a scar changes, are left out.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import block_diag

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.sphere_model.recording import Recording, search_data
from heartfit.discovery.sphere_model.strokes import GAIN_SD
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.curve import Curve
from heartfit.observation.regional import (
    BASE_DESCENT,
    CIRCUMFERENTIAL,
    KINDS,
    kind_of,
    names_of_kind,
    regional_curves,
)
from heartfit.observation.regional_noise import RegionalNoise, later_samples

FOLLOWED = 12
"""Number of the basal and the middle segments, which registration follows."""
SEARCHED = (*names_of_kind(CIRCUMFERENTIAL)[:FOLLOWED], BASE_DESCENT)
"""Names of the regional curves that a search explains."""
RIGHT_VOLUME = "rv_volume"
STRAIN = Noise((1e-4,), 0.0, 0.004, 0.02)
DESCENT = Noise((1e-5,), 0.0, 3e-4, 2e-3)
"""Roughness and discrepancy of a strain [1] and of the descent of the base [m]."""
NOISE_SCALES = (0.7, 1.0, 1.5)
"""Standard deviations of the learned noise that are tried, as multiples; a heart that registration follows badly has
more."""


@dataclass(frozen=True, eq=False)
class WallRecording:
    """Volumes and pressures of a heart, and the registered motion of its mesh with its noise."""

    recording: Recording
    mesh: VentricularMesh
    motion: Motion
    noise: RegionalNoise

    @property
    def frames(self) -> Floats:
        """Times (p,) of the images [s after the trigger]."""
        return self.motion.times

    @property
    def has_pressure(self) -> bool:
        """True if a left ventricular pressure was recorded."""
        return "lv_pressure" in self.recording.curves

    def without_pressure(self) -> "WallRecording":
        """The same recording without any pressure."""
        curves = {name: one for name, one in self.recording.curves.items() if not name.endswith("_pressure")}
        return replace(self, recording=replace(self.recording, curves=curves))

    def data(self) -> Data:
        """Data of the search: pressures, the balance of both sides and volumes, then the regional curves."""
        both = RIGHT_VOLUME in self.recording.curves
        whole = _right_volume_last(search_data(replace(self.recording, unsearched={}, balanced=both)))
        curves = self.noise.corrected(regional_curves(self.mesh, self.motion))
        blocks = tuple(_block(name, curves[name]) for name in SEARCHED)
        values = np.concatenate([whole.values, *(curves[name].values[1:] for name in SEARCHED)])
        right = [_gain_covariance(whole.values[whole.rows[-1]])] if both else []
        tied = block_diag(*right, self._covariance(curves))
        structure = np.zeros((values.size, values.size))
        structure[-len(tied) :, -len(tied) :] = tied
        return Data(values, (*whole.blocks, *blocks), structure, NOISE_SCALES)

    def _covariance(self, curves: dict[str, Curve]) -> Floats:
        """Covariance of the searched regional samples."""
        ordered = {name: curves[name] for kind in KINDS for name in names_of_kind(kind)}
        owners, later = np.repeat(list(ordered), self.frames.size), later_samples(ordered)
        rows = later[np.isin(owners[later], SEARCHED)]
        covariance: Floats = self.noise.corrected_covariance(ordered)[np.ix_(rows, rows)]
        return covariance


def _right_volume_last(data: Data) -> Data:
    """The same data with the right volume, if there is one, after all other blocks."""
    order = sorted(range(len(data.blocks)), key=lambda place: data.blocks[place].curve == RIGHT_VOLUME)
    values = np.concatenate([data.values[data.rows[place]] for place in order])
    return Data(values, tuple(data.blocks[place] for place in order))


def _gain_covariance(volumes: Floats) -> Floats:
    """Covariance (k, k) by the gain of right volumes (k,) [m^6], the first of which the mesh has."""
    change = GAIN_SD * (volumes - volumes[0])
    return np.outer(change, change)


def _block(name: str, curve: Curve) -> Block:
    unit, noise = ("m", DESCENT) if kind_of(name) == BASE_DESCENT else ("1", STRAIN)
    return Block(name, unit, curve.times[1:], curve.period, noise)
