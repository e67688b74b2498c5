"""A loss of pressure in the mitral valve."""

from dataclasses import dataclass

from heartfit.places.valve_loss import ValveLoss


@dataclass(frozen=True)
class MitralLoss(ValveLoss):
    """In series with the mitral valve."""

    region = "filling"
    slot = "a loss of pressure in the mitral valve"
    valve = "mitral"
    amplitude = 1e8
