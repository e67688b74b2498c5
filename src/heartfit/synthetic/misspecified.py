r"""Misspecified hearts: other centres, other errors of the recording, and an earlier R wave than the search assumes.

The hidden hearts of :mod:`heartfit.synthetic.hidden` share with the search the centres of their parameters, the levels
of the noise and the memory of the frames. Patients share none of these. Here every heart has centres of its own,

.. math:: \theta = \bar\theta\, e^{s (m + z)}, \qquad |m| \sim U(1, 2), \qquad z \sim N(0, 1),

for eight parameters: filling, stiffness and amount of the wall, contractility, load, relaxation, duration of the action
potential and inertance of the mitral blood. The search frees all of them but the amount of the wall, which it holds.

The R wave leads the upstroke of the pressure by 20 to 40 ms more than in the model, as the coupling of excitation to
contraction takes time. Hence the trigger is earlier and the whole recording appears later.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from heartfit.synthetic.campaign import Inadmissible
from heartfit.synthetic.hidden import MEMORY, WALL_AMOUNT, HiddenHeart, RecordingProtocol, draw_hidden

SHIFTED = (
    "circulation.left_atrium",
    WALL_AMOUNT,
    "sigma_0",
    "c_1",
    "R_p",
    "k_RS",
    "duration",
    "mitral inertance",
)
"""Parameters whose centres are shifted, by their names in :func:`draw_hidden`."""
SHIFT = (1.0, 2.0)
"""Range of the shift of a centre [standard deviations of the parameter], of either sign."""
NOISE_RATIOS = (0.5, 2.0)
"""Ratios of the standard deviations of the errors to those as searched."""
MEMORIES = (0.2, 0.85)
"""Correlations of the errors of successive frames."""
TRIGGER_LEAD = (0.02, 0.04)
"""Range of the lead of the R wave [s]."""


@dataclass(frozen=True)
class Misspecification:
    """Departure of a hidden heart and of its recording from the assumptions of the search; none by default.

    centres: shifts by parameter [standard deviations]; volume_noise, catheter_noise: ratios of the errors to those as
    searched; memory: correlation of the errors of successive frames; trigger_lead: of the R wave [s].
    """

    centres: Mapping[str, float] = field(default_factory=dict)
    volume_noise: float = 1.0
    catheter_noise: float = 1.0
    memory: float = MEMORY
    trigger_lead: float = 0.0

    @classmethod
    def draw(cls, rng: np.random.Generator) -> "Misspecification":
        """Draw a departure in all respects."""
        sizes, signs = rng.uniform(*SHIFT, len(SHIFTED)), rng.choice((-1.0, 1.0), len(SHIFTED))
        volume, catheter = rng.choice(NOISE_RATIOS, 2).tolist()
        return cls(
            dict(zip(SHIFTED, (sizes * signs).tolist(), strict=True)),
            volume,
            catheter,
            float(rng.choice(MEMORIES)),
            float(rng.uniform(*TRIGGER_LEAD)),
        )

    def draw_heart(self, rng: np.random.Generator) -> HiddenHeart:
        """Draw a heart about these centres.

        Raises Inadmissible for an R wave before the earliest activation.
        """
        hidden = draw_hidden(rng, self.centres)
        delay = hidden.heart.tissue.control.trigger_delay - self.trigger_lead
        if delay < 0.0:
            raise Inadmissible("R wave before the activation")
        return replace(hidden, heart=hidden.heart.with_parameters({"trigger_delay": delay}))

    def draw_protocol(self, rng: np.random.Generator) -> RecordingProtocol:
        """Draw a protocol with these errors."""
        protocol = RecordingProtocol.draw(rng)
        noise = self.volume_noise * protocol.noise
        return replace(protocol, noise=noise, memory=self.memory, catheter=self.catheter_noise)


AS_SEARCHED = Misspecification()
"""No departure."""
