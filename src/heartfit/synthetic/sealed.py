"""Hidden effects of sealed hearts, drawn by a seed from the effects that a volume and a pressure can show.

The draw takes a mechanism of the library that acts on the heart, not on a sensor, and a size; both are drawn again
until half the size is expected to be detected. A search for an effect below its detection limit would only show the
limit.
"""

import numpy as np

from heartfit.discovery.inference.decide import CENTRED_RULES
from heartfit.discovery.sphere_model.limits import expected_evidence
from heartfit.roles import Mechanism, Sensor, registered
from heartfit.synthetic.campaign import DRAWN, Effect, Inadmissible, draw_effect, effects_of, plantable

SIZES = (2.5, 4.0)
"""Range of the drawn size [scales of the mechanism]."""
MARGIN = 2.0
"""Factor by which the size exceeds one that is expected to be detected."""


def hidden_effects(plant: str | None, scales: float, seed: int) -> tuple[Effect, ...]:
    """Return the hidden effect: none, one by name with its size in scales, or one that the seed draws."""
    if plant is None:
        return ()
    if plant == DRAWN:
        return (draw_visible_effect(seed),)
    kind = registered()[plant]
    return effects_of([kind(**{kind.switch().name: kind.switch().at(scales)})], scales)


def draw_visible_effect(seed: int) -> Effect:
    """Draw an effect on the heart until it can be seen."""
    rng = np.random.default_rng([seed, 1])
    hearts = [name for name, kind in plantable().items() if not issubclass(kind, Sensor)]
    while True:
        kind, scales = plantable()[str(rng.choice(hearts))], float(rng.uniform(*SIZES))
        try:
            effect = draw_effect(kind, scales, rng)
        except Inadmissible:
            continue
        if is_visible(effect, scales):
            return effects_of([effect], scales)[0]


def is_visible(effect: Mechanism, scales: float) -> bool:
    """True if ``1 / MARGIN`` of the size is expected to be detected in the average adult."""
    switch = effect.switch()
    sign = float(np.sign(getattr(effect, switch.name) - (switch.off or 0.0)))
    return expected_evidence(type(effect).__name__, sign * scales / MARGIN) >= CENTRED_RULES.detected
