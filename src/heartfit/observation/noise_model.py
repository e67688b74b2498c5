r"""Noise model of a scanner and its registration, estimated from sequences of known truth.

Registration starts from the end-diastolic mesh, so its error grows with the motion that it follows. The model therefore
divides the error by a scale of the motion that the measurement itself has. For the volume at a phase of the beat, and
for the extremum of a curve, the scale is the range of the measured curve (the stroke volume for V_min); for a rate it
is the rate,

.. math::
    e(\varphi) = \frac{V^{measured}(\varphi) - V^{true}(\varphi)}{SV^{measured}}, \quad
    e_{extremum} = \frac{y^{measured} - y^{true}}{range^{measured}}, \quad
    e_{rate} = \ln \frac{y^{measured}}{y^{true}} .

Each can be inverted exactly for the unknown true value. A motion that is shrunk by s has e = s / (1 - s) at end systole
in every heart, whereas an error relative to V_min would depend on the ejection fraction; a logarithm is as large for
twice as for half the true rate. Bias and covariance of the errors over N >= 20 sequences are the model;
:mod:`heartfit.observation.scatter` gives the distribution of the next sequence.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.observation.curve import Curve
from heartfit.observation.operator import Pair, PressureFeatures, Reading, VolumeFeatures
from heartfit.observation.scatter import Scatter

MIN_SEQUENCES = 20
"""Fewest sequences from which a model may be estimated."""
CURVE_PHASES = 25
"""Default number of equidistant phases of the volume curve in a model."""
VOLUMES = ("lv_volume", "rv_volume")
CURVE_OF_EXTREMUM = {VolumeFeatures.names[0]: "lv_volume", PressureFeatures.names[0]: "lv_pressure"}
"""Curve whose range scales the error of an observation, by observation; all others are rates."""
NEGLIGIBLE_SD = 1e-9
"""Standard deviation over the stroke volume below which coverage leaves out a phase."""
Setting = float | int | str | bool


@dataclass(frozen=True, eq=False)
class StrainError:
    """Mean ``bias`` (3, 16) and deviation ``sd`` (3, 16) of registered less true strain of segments at end systole."""

    bias: Floats
    sd: Floats


@dataclass(frozen=True, eq=False)
class NoiseModel:
    """Bias and covariance of the errors of one imaging protocol.

    protocol: the settings of scanner and registration that the model holds for; observations: scatter of their errors
    by name; curves: scatter of the error of each volume, one component for each phase, with shrunken correlations: that
    of the thin right wall is another one; strain: of segments, None if it was not compared. Raises InputError for fewer
    than MIN_SEQUENCES sequences.
    """

    protocol: Mapping[str, Setting]
    observations: Scatter
    curves: Mapping[str, Scatter]
    strain: StrainError | None = None

    def __post_init__(self) -> None:
        _require_sequences(self.sequences)

    @classmethod
    def from_pairs(
        cls, pairs: Sequence[Pair], protocol: Mapping[str, Setting], phases: int = CURVE_PHASES
    ) -> "NoiseModel":
        """Estimate the model from one pair for each sequence, all of one protocol.

        Raises InputError for fewer than MIN_SEQUENCES pairs, and for a pair whose observations are not those of the
        first or whose rates differ in sign from the truth.
        """
        _require_sequences(len(pairs))
        names = tuple(pairs[0].true.observations)
        errors = np.array([observation_errors(pair, names, number) for number, pair in enumerate(pairs)])
        labels = [f"phase {phase} of {phases}" for phase in range(phases)]
        curves = {
            name: Scatter.from_sample(
                labels, np.array([curve_error(pair, phases, name) for pair in pairs]), shrunk=True
            )
            for name in VOLUMES
            if name in pairs[0].true.curves
        }
        return cls(protocol, Scatter.from_sample(names, errors), curves)

    @property
    def sequences(self) -> int:
        """Number of sequences from which the model was estimated."""
        return self.observations.count

    @property
    def phases(self) -> int:
        """Number of equidistant phases of the volumes."""
        return len(self.curves["lv_volume"].names)

    def mean_unsigned_error(self, name: str) -> float:
        r"""Mean of the unsigned error of an observation, which is normal with the bias m and the deviation s.

        .. math:: s \sqrt{2/\pi}\, e^{-m^2/2s^2} + m\, \mathrm{erf}(m / (s \sqrt 2))
        """
        place = self.observations.names.index(name)
        bias, sd = float(self.observations.mean[place]), float(self.observations.sd[place])
        ratio = bias / (sd * math.sqrt(2.0))
        return sd * math.sqrt(2.0 / math.pi) * math.exp(-(ratio**2)) + bias * math.erf(ratio)

    def require_protocol(self, protocol: Mapping[str, Setting]) -> None:
        """Raise InputError unless images have the protocol of the model."""
        names = sorted(set(self.protocol) | set(protocol))
        for name in names:
            expected, actual = self.protocol.get(name), protocol.get(name)
            if actual != expected:
                raise InputError(
                    f"noise model: {name} is {actual}, but the model was made for {expected}; "
                    "expected images of its protocol: make a model for the protocol of these images"
                )

    def corrected(self, measured: Reading) -> dict[str, float]:
        """Return the observations without their bias, by name [SI]."""
        bias = self.observations.mean[self._places(measured.observations)]
        return dict(zip(measured.observations, _true_values(measured, bias).tolist(), strict=True))

    def covariance(self, measured: Reading) -> Floats:
        """Covariance (m, m) of the truth about the corrected observations, in their order [SI].

        R = diag(d) S (1 + 1/N) diag(d) with d the range of the curve for an extremum and the corrected value for a
        rate, whose logarithm is linearised.
        """
        places = self._places(measured.observations)
        scales = _scales(measured)
        sizes = np.where(np.isnan(scales), list(self.corrected(measured).values()), scales)
        return np.outer(sizes, sizes) * self.observations.predictive[np.ix_(places, places)]

    def interval(self, measured: Reading, level: float = 0.95) -> dict[str, tuple[float, float]]:
        """Return the interval (low, high) [SI] of each true value at probability ``level``, by name."""
        places = self._places(measured.observations)
        bias, reach = self.observations.mean[places], self.observations.half_width(level)[places]
        ends = np.sort([_true_values(measured, bias - reach), _true_values(measured, bias + reach)], axis=0)
        return dict(zip(measured.observations, map(tuple, ends.T.tolist()), strict=True))

    def corrected_curve(self, volume: Curve, name: str = "lv_volume") -> Curve:
        """Return the named measured volume [m^3] at the phases of the model, without the bias."""
        frames, stroke = self._at_phases(volume)
        return Curve(frames.times, frames.values - stroke * self.curves[name].mean, frames.period)

    def curve_covariance(self, volume: Curve, name: str = "lv_volume") -> Floats:
        """Covariance (k, k) [m^6] of the true volume about the corrected one, over the phases of the model.

        A row is zero in a phase without error, such as the first, where registration starts from the mesh.
        """
        covariance: Floats = self._at_phases(volume)[1] ** 2 * self.curves[name].predictive
        return covariance

    def curve_interval(
        self, volume: Curve, level: float = 0.95, name: str = "lv_volume"
    ) -> tuple[Floats, Floats]:
        """Interval (low, high) (k,) [m^3] of the true volume at probability ``level`` in each phase of the model."""
        middle = self.corrected_curve(volume, name).values
        reach = self._at_phases(volume)[1] * self.curves[name].half_width(level)
        return middle - reach, middle + reach

    def _at_phases(self, volume: Curve) -> tuple[Curve, float]:
        frames = volume.resampled(self.phases)
        return frames, float(np.ptp(frames.values))

    def _places(self, observed: Mapping[str, float]) -> Integers:
        unknown = [name for name in observed if name not in self.observations.names]
        if unknown:
            raise InputError(
                f"noise model: no observation {', '.join(unknown)}; expected {', '.join(self.observations.names)}: "
                "observe only these or make a model with all of them"
            )
        return np.array([self.observations.names.index(name) for name in observed], dtype=np.int64)


def _require_sequences(sequences: int) -> None:
    if sequences < MIN_SEQUENCES:
        raise InputError(
            f"noise model: {sequences} sequences; expected at least {MIN_SEQUENCES}: simulate and register more"
        )


def observation_errors(pair: Pair, names: Sequence[str], number: int = 0) -> Floats:
    """Errors (m,) of the named observations of a pair; ``number`` is that of its sequence, for messages.

    Raises InputError for a pair with other observations, and for a rate whose sign is not that of the true one.
    """
    true, measured = pair.true.observations, pair.measured.observations
    if not set(true) == set(measured) == set(names):
        raise InputError(
            f"noise model: sequence {number} has the observations {', '.join(true)} (true) and "
            f"{', '.join(measured)} (measured); expected {', '.join(names)}: observe all sequences alike"
        )
    return np.array([_error(pair, name, number) for name in names])


def _error(pair: Pair, name: str, number: int) -> float:
    true, measured = pair.true.observations[name], pair.measured.observations[name]
    if name in CURVE_OF_EXTREMUM:
        return (measured - true) / _range(pair.measured, name)
    if not measured / true > 0.0:
        raise InputError(
            f"noise model: sequence {number} has {name} = {measured:g} for a true {true:g}; "
            "expected the same sign: look at its registration"
        )
    return float(np.log(measured / true))


def _true_values(measured: Reading, errors: Floats) -> Floats:
    """True values (m,) of a measurement with these errors."""
    values, scales = np.array(list(measured.observations.values())), _scales(measured)
    truths: Floats = np.where(np.isnan(scales), values * np.exp(-errors), values - scales * errors)
    return truths


def _scales(measured: Reading) -> Floats:
    """Range of the curve for each extremum (m,), NaN for a rate."""
    return np.array(
        [_range(measured, name) if name in CURVE_OF_EXTREMUM else np.nan for name in measured.observations]
    )


def _range(measured: Reading, name: str) -> float:
    return float(np.ptp(measured.curves[CURVE_OF_EXTREMUM[name]].values))


def curve_error(pair: Pair, phases: int, name: str = "lv_volume") -> Floats:
    """(V_measured - V_true) / SV_measured (k,) of the named volume of one pair, at equidistant phases."""
    true, measured = (reading.curves[name].resampled(phases) for reading in (pair.true, pair.measured))
    error: Floats = (measured.values - true.values) / np.ptp(measured.values)
    return error


@dataclass(frozen=True)
class Share:
    """Covered share of ``sequences`` and the exact confidence interval (low, high) of its probability.

    Reference: Clopper CJ, Pearson ES 1934, doi 10.1093/biomet/26.4.404.
    """

    covered: float
    sequences: int
    low: float
    high: float

    @classmethod
    def from_count(cls, covered: float, sequences: int, level: float = 0.95) -> "Share":
        """Return the share for ``covered`` of ``sequences`` sequences, with its interval at ``level``."""
        from scipy.special import betaincinv  # many jobs import noise models, few need shares

        missed, tail = sequences - covered, 0.5 * (1.0 - level)
        low = float(betaincinv(covered, missed + 1.0, tail)) if covered > 0.0 else 0.0
        high = float(betaincinv(covered + 1.0, missed, 1.0 - tail)) if missed > 0.0 else 1.0
        return cls(covered / sequences, sequences, low, high)


def coverage(model: NoiseModel, pairs: Sequence[Pair], level: float = 0.95) -> dict[str, Share]:
    """Share of independent pairs whose truth lies in the interval of the model, by observation and volume.

    The share of a volume is the mean over the phases. The errors of the phases of one sequence are correlated, so
    its confidence interval counts a sequence, not a phase, as one trial, which makes it conservative.
    """
    return _shares([_covered(model, pair, level) for pair in pairs])


def leave_one_out_coverage(
    pairs: Sequence[Pair], protocol: Mapping[str, Setting], level: float = 0.95
) -> dict[str, Share]:
    """Coverage where the model of all other pairs judges each pair in turn."""
    covered = [
        _covered(NoiseModel.from_pairs([*pairs[:index], *pairs[index + 1 :]], protocol), pair, level)
        for index, pair in enumerate(pairs)
    ]
    return _shares(covered)


def _shares(covered: Sequence[Mapping[str, float]]) -> dict[str, Share]:
    return {name: Share.from_count(sum(pair[name] for pair in covered), len(covered)) for name in covered[0]}


def _covered(model: NoiseModel, pair: Pair, level: float) -> dict[str, float]:
    """Coverage of one pair: 1 or 0 for each observation, the share of the phases for each volume."""
    true = pair.true.observations
    intervals = model.interval(pair.measured, level)
    covered = {name: float(low <= true[name] <= high) for name, (low, high) in intervals.items()}
    return covered | {
        name: float(np.mean(_phases_covered(model, pair, level, name))) for name in model.curves
    }


def _phases_covered(model: NoiseModel, pair: Pair, level: float, name: str) -> Floats:
    low, high = model.curve_interval(pair.measured.curves[name], level, name)
    true = pair.true.curves[name].resampled(len(low)).values
    return ((low <= true) & (true <= high))[model.curves[name].sd > NEGLIGIBLE_SD].astype(float)
