r"""What a scanner with its registration makes of a beat, learnt from sequences whose truth is known.

An observation is scaled by the measurement, never turned round: its error is the logarithm of a ratio,

.. math:: e_i = \ln(y_i^{measured} / y_i^{true}), \quad y_i^{true} = y_i^{measured} e^{-e_i} ,

which is as large for twice as for half the true value and is inverted exactly, for the truth is what is not known.
The error of the left ventricle's volume is compared with a scale that the measurement itself has, its stroke volume,

.. math:: e(\varphi) = (V^{measured}(\varphi) - V^{true}(\varphi)) / SV^{measured} ,

at equidistant phases of the beat from the trigger on. Bias and covariance of both over N >= 20 sequences are the model;
see :mod:`heartfit.observation.scatter` for what N sequences say of the next one.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.observation.curve import Curve
from heartfit.observation.pair import Pair
from heartfit.observation.scatter import Scatter

FEWEST_SEQUENCES = 20
PHASES = 25
Setting = float | int | str | bool


@dataclass(frozen=True, eq=False)
class NoiseModel:
    """Bias and covariance of what is measured by one protocol.

    protocol: the settings of scanner and registration the model was made for; observations: scatter of ln(measured /
    true) by name; curve: scatter of the volume's error over the measured stroke volume, one component for each phase,
    with shrunken correlations. Raises InputError for fewer than 20 sequences.
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
        errors = np.array([_logarithms(number, pair, names) for number, pair in enumerate(pairs)])
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

    def corrected(self, observed: Mapping[str, float]) -> dict[str, float]:
        """The observations, SI, without the bias: y exp(-b)."""
        factors = np.exp(-self.observations.mean[self._places(observed)])
        return {
            name: value * float(factor)
            for (name, value), factor in zip(observed.items(), factors, strict=True)
        }

    def covariance(self, observed: Mapping[str, float]) -> Floats:
        """Covariance (m, m) of the truth about the corrected observations, in their order and SI.

        R = diag(y) S (1 + 1/N) diag(y) with the corrected y: of first order in the logarithms.
        """
        places = self._places(observed)
        values = np.array(list(self.corrected(observed).values()))
        return np.outer(values, values) * self.observations.predictive[np.ix_(places, places)]

    def interval(self, observed: Mapping[str, float], level: float = 0.95) -> dict[str, tuple[float, float]]:
        """Where the true values lie with probability ``level`` each: least and largest, SI."""
        stretch = np.exp(self.observations.reach(level)[self._places(observed)])
        return {
            name: (min(value / factor, value * factor), max(value / factor, value * factor))
            for (name, value), factor in zip(self.corrected(observed).items(), stretch.tolist(), strict=True)
        }

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


def _logarithms(number: int, pair: Pair, names: Sequence[str]) -> Floats:
    """ln(measured / true) (m,) of one pair."""
    true, measured = pair.true.observations, pair.measured.observations
    if not set(true) == set(measured) == set(names):
        raise InputError(
            f"noise model: sequence {number} has the observations {', '.join(true)} (true) and "
            f"{', '.join(measured)} (measured); expected {', '.join(names)}: observe all sequences alike"
        )
    ratios = np.array([measured[name] / true[name] for name in names])
    if not (ratios > 0.0).all():
        name = names[int(np.argmin(ratios > 0.0))]
        raise InputError(
            f"noise model: sequence {number} has {name} = {measured[name]:g} for a true {true[name]:g}; "
            "expected the same sign: look at its registration"
        )
    return np.log(ratios)


def curve_error(pair: Pair, phases: int) -> Floats:
    """(V_measured - V_true) / SV_measured (k,) of the LV volume of one pair, at equidistant phases."""
    true, measured = (reading.curves["lv_volume"].resampled(phases) for reading in (pair.true, pair.measured))
    error: Floats = (measured.values - true.values) / np.ptp(measured.values)
    return error
