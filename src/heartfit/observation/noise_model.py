r"""What a scanner with its registration makes of a beat, learnt from sequences whose truth is known.

Registration starts from the end-diastolic mesh, so its error grows with the motion that it follows. It is therefore
compared with a scale of the motion that the measurement itself has. For the volume at a phase of the beat, and for the
extremum of a curve, that is the range of the measured curve, the stroke volume for V_min; for a rate it is the rate,

.. math::
    e(\varphi) = \frac{V^{measured}(\varphi) - V^{true}(\varphi)}{SV^{measured}}, \quad
    e_{extremum} = \frac{y^{measured} - y^{true}}{range^{measured}}, \quad
    e_{rate} = \ln \frac{y^{measured}}{y^{true}} .

Both are inverted exactly for the truth, which is what is not known. A motion that is shrunk by s has e = s / (1 - s)
at end systole whatever the heart, where an error relative to V_min would depend on the ejection fraction; a logarithm
is as large for twice as for half the true rate. Bias and covariance of the errors over N >= 20 sequences are the
model; see :mod:`heartfit.observation.scatter` for what N sequences say of the next one.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.observation.curve import Curve
from heartfit.observation.operator import PressureFeatures, VolumeFeatures
from heartfit.observation.pair import Pair, Reading
from heartfit.observation.scatter import Scatter

FEWEST_SEQUENCES = 20
PHASES = 25
EXTREMA = {VolumeFeatures.names[0]: "lv_volume", PressureFeatures.names[0]: "lv_pressure"}
"""Observations that are compared with the range of a curve, and which; the others are rates."""
Setting = float | int | str | bool


@dataclass(frozen=True, eq=False)
class NoiseModel:
    """Bias and covariance of what is measured by one protocol.

    protocol: the settings of scanner and registration the model was made for; observations: scatter of their errors by
    name; curve: scatter of the error of the volume, one component for each phase, with shrunken correlations. Raises
    InputError for fewer than 20 sequences.
    """

    protocol: Mapping[str, Setting]
    observations: Scatter
    curve: Scatter

    def __post_init__(self) -> None:
        _require_enough(self.sequences)

    @classmethod
    def of(cls, pairs: Sequence[Pair], protocol: Mapping[str, Setting], phases: int = PHASES) -> "NoiseModel":
        """The model from one pair for each sequence, all of one protocol.

        Raises InputError for too few pairs, and for one whose observations are not those of the first or differ in
        sign from the truth.
        """
        _require_enough(len(pairs))
        names = tuple(pairs[0].true.observations)
        errors = np.array([observation_errors(pair, names, number) for number, pair in enumerate(pairs)])
        curves = np.array([curve_error(pair, phases) for pair in pairs])
        labels = [f"phase {phase} of {phases}" for phase in range(phases)]
        return cls(protocol, Scatter.of(names, errors), Scatter.of(labels, curves, shrunk=True))

    @property
    def sequences(self) -> int:
        """From how many sequences it was learnt."""
        return self.observations.count

    def require_protocol(self, protocol: Mapping[str, Setting]) -> None:
        """Raises InputError for images of another protocol than that of the model."""
        names = sorted(set(self.protocol) | set(protocol))
        for name in names:
            made, given = self.protocol.get(name), protocol.get(name)
            if made != given:
                raise InputError(
                    f"noise model: {name} is {given}, the model was made for {made}; "
                    "expected images of its protocol: make a model of theirs"
                )

    def corrected(self, measured: Reading) -> dict[str, float]:
        """The observations, SI, without the bias."""
        bias = self.observations.mean[self._places(measured.observations)]
        return dict(zip(measured.observations, _truths(measured, bias).tolist(), strict=True))

    def covariance(self, measured: Reading) -> Floats:
        """Covariance (m, m) of the truth about the corrected observations, in their order and SI.

        R = diag(d) S (1 + 1/N) diag(d) with d the range of the curve for an extremum and the corrected value for a
        rate, whose logarithm is taken to first order.
        """
        places = self._places(measured.observations)
        scales = _scales(measured)
        sizes = np.where(np.isnan(scales), list(self.corrected(measured).values()), scales)
        return np.outer(sizes, sizes) * self.observations.predictive[np.ix_(places, places)]

    def interval(self, measured: Reading, level: float = 0.95) -> dict[str, tuple[float, float]]:
        """Where the true values lie with probability ``level`` each: least and largest, SI."""
        places = self._places(measured.observations)
        bias, reach = self.observations.mean[places], self.observations.reach(level)[places]
        ends = np.sort([_truths(measured, bias - reach), _truths(measured, bias + reach)], axis=0)
        return dict(zip(measured.observations, map(tuple, ends.T.tolist()), strict=True))

    def corrected_curve(self, volume: Curve) -> Curve:
        """A measured LV volume at the model's phases, m^3, without the bias."""
        frames, stroke = self._at_phases(volume)
        return Curve(frames.times, frames.values - stroke * self.curve.mean, frames.period)

    def curve_covariance(self, volume: Curve) -> Floats:
        """Covariance (k, k) in m^6 of the true volume about the corrected one, over the model's phases.

        Where the error never varies, as in the first phase if the mesh is given there, a row is zero.
        """
        covariance: Floats = self._at_phases(volume)[1] ** 2 * self.curve.predictive
        return covariance

    def curve_interval(self, volume: Curve, level: float = 0.95) -> tuple[Floats, Floats]:
        """Least and largest true volume (k,) in m^3, with probability ``level`` in each of the model's phases."""
        middle, reach = (
            self.corrected_curve(volume).values,
            self._at_phases(volume)[1] * self.curve.reach(level),
        )
        return middle - reach, middle + reach

    def _at_phases(self, volume: Curve) -> tuple[Curve, float]:
        frames = volume.resampled(len(self.curve.names))
        return frames, float(np.ptp(frames.values))

    def _places(self, observed: Mapping[str, float]) -> Integers:
        unknown = [name for name in observed if name not in self.observations.names]
        if unknown:
            raise InputError(
                f"noise model: knows nothing of {', '.join(unknown)}; expected {', '.join(self.observations.names)}: "
                "observe these only or make a model with the others"
            )
        return np.array([self.observations.names.index(name) for name in observed], dtype=np.int64)


def _require_enough(sequences: int) -> None:
    if sequences < FEWEST_SEQUENCES:
        raise InputError(
            f"noise model: {sequences} sequences; expected at least {FEWEST_SEQUENCES}: simulate and register more"
        )


def observation_errors(pair: Pair, names: Sequence[str], number: int = 0) -> Floats:
    """Errors (m,) of the observations of a pair, by name; ``number`` tells its sequence.

    Raises InputError for other observations than these, and for a rate of another sign than the true one.
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
    if name in EXTREMA:
        return (measured - true) / _range(pair.measured, name)
    if not measured / true > 0.0:
        raise InputError(
            f"noise model: sequence {number} has {name} = {measured:g} for a true {true:g}; "
            "expected the same sign: look at its registration"
        )
    return float(np.log(measured / true))


def _truths(measured: Reading, errors: Floats) -> Floats:
    """True values (m,) of what was measured with these errors."""
    values, scales = np.array(list(measured.observations.values())), _scales(measured)
    truths: Floats = np.where(np.isnan(scales), values * np.exp(-errors), values - scales * errors)
    return truths


def _scales(measured: Reading) -> Floats:
    """Range (m,) of the curve of each extremum, NaN for a rate."""
    return np.array([_range(measured, name) if name in EXTREMA else np.nan for name in measured.observations])


def _range(measured: Reading, name: str) -> float:
    return float(np.ptp(measured.curves[EXTREMA[name]].values))


def curve_error(pair: Pair, phases: int) -> Floats:
    """(V_measured - V_true) / SV_measured (k,) of the LV volume of one pair, at equidistant phases."""
    true, measured = (reading.curves["lv_volume"].resampled(phases) for reading in (pair.true, pair.measured))
    error: Floats = (measured.values - true.values) / np.ptp(measured.values)
    return error
