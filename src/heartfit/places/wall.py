"""Places in the wall: its load, its elasticity, and the activation and the bridges of its muscle."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.geometry.territory import ACTIVATION_ORDER, REGIONS
from heartfit.places.place import FunctionOfState, FunctionOfTime
from heartfit.roles import Attachment, Delay, External, Relaxation, Stress
from heartfit.roles.laws import Load


@dataclass(frozen=True)
class WallPressure(FunctionOfTime, External):
    """Pressure [Pa] added to that of the left ventricle at a given volume: by muscle, wall or what lies around it."""

    region = "wall"
    slot = "the pressure on the wall of the left ventricle"
    unit = "Pa"
    amplitude = 6000.0

    def load(self, ventricle: str, time: Floats, period: float) -> Load:  # noqa: ARG002
        return Load(pulse=self.function.at(time)) if ventricle == "lv" else Load()


@dataclass(frozen=True)
class WallElasticity(FunctionOfState, Stress):
    r"""Derivative of the energy of the wall [Pa] by the invariant :math:`x = \bar I_1 - 3`, free up to x = RANGE.

    .. math:: W'(x) = x f(x / x_{max}) ,

    so that the reference stays free of stress. It acts while the wall contracts, too.
    """

    region = "wall"
    slot = "the elasticity of the wall"
    unit = "Pa"
    amplitude = 6000.0
    acts_on = "wall"
    RANGE = 1.2

    def slopes(self, x: Floats) -> tuple[Floats, Floats]:
        u = np.asarray(x) / self.RANGE
        value = self.function.at(u)
        return x * value, value + u * self.function.slope_at(u)


@dataclass(frozen=True)
class AttachmentRate(FunctionOfTime, Attachment):
    """Share added to the rate k_ATP at a time after activation, also after repolarisation."""

    region = "muscle"
    slot = "the rate at which the bridges of the muscle attach"
    unit = "1"
    amplitude = 0.3
    zero = "activation"

    def added_integral(self, time: Floats) -> Floats:
        return self.function.integral(time)


@dataclass(frozen=True)
class DetachmentRate(FunctionOfState, Relaxation):
    r"""Factor :math:`e^{f(t)}` on the rate k_RS at the time t after repolarisation, up to SPAN [s]."""

    region = "muscle"
    slot = "the rate at which the bridges of the muscle detach"
    unit = "1"
    amplitude = 0.5
    SPAN = 0.5
    GRID = 200
    """Number of intervals over which the factor is integrated."""

    def missing_integral(self, time: Floats) -> Floats:
        ends = np.linspace(0.0, self.SPAN, self.GRID + 1)
        missing = -np.expm1(self.function.at(0.5 * (ends[:-1] + ends[1:]) / self.SPAN))
        integral = np.concatenate([[0.0], np.cumsum(missing) * self.SPAN / self.GRID])
        return np.interp(time, ends, integral)


@dataclass(frozen=True)
class ActivationDelay(FunctionOfState, Delay):
    r"""Delay :math:`f(u) - f(0)` [s] of the AHA segments by their rank u, 0 to 1, in the order of activation in health.

    It may be negative. The segment that is first in health and the right ventricular wall keep their activation.
    """

    region = "muscle"
    slot = "the activation of parts of the wall"
    unit = "s"
    amplitude = 0.03

    def delay(self) -> Floats:
        delays = np.zeros(REGIONS)
        ranks = np.arange(len(ACTIVATION_ORDER)) / (len(ACTIVATION_ORDER) - 1.0)
        values = self.function.at(ranks)
        delays[ACTIVATION_ORDER] = values - values[0]
        return delays
