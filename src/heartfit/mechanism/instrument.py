"""The role of mechanisms that act on what is measured: instruments."""

from abc import abstractmethod
from typing import ClassVar

from heartfit.geometry.arrays import Floats
from heartfit.mechanism.base import Mechanism


class Sensor(Mechanism):
    """What an instrument makes of a curve: it enters the measurement, and the heart does not feel it.

    Several sensors act one after the other, in the order in which they were added to the heart.
    """

    measures: ClassVar[tuple[str, ...]]
    """Names of the curves that it measures, as :meth:`heartfit.beat.Beat.signals` gives them."""

    @abstractmethod
    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        """What it shows (t,) of the periodic curve ``values`` (t,), SI, at ``times`` (t,), s after the trigger."""
