"""A loss of pressure in the aortic valve."""

from dataclasses import dataclass

from heartfit.places.valve_loss import ValveLoss


@dataclass(frozen=True)
class AorticLoss(ValveLoss):
    """In series with the aortic valve."""

    region = "ejection"
    slot = "a loss of pressure in the aortic valve"
    valve = "aortic"
    amplitude = 1e8
