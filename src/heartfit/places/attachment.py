"""A rate of attachment of the bridges."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.places.place import FunctionOfTime
from heartfit.roles import Attachment


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
