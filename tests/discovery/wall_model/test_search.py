"""The search on a wall in closed form: scars and late walls are named and placed, sound walls are not."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.inference.evidence import Explanation
from heartfit.discovery.sphere_model.forward_model import Candidate
from heartfit.discovery.wall_model.search import WallFindings, search_wall
from heartfit.discovery.wall_model.territory import most_probable_angle, probability_of_segments
from heartfit.discovery.wall_model.unknowns import ACTIVATION_SD, CONTRACTILITY_SD, COORDINATES, NAMES
from heartfit.geometry.territory import territory_weights
from heartfit.mechanisms.delayed_activation import DelayedActivation
from heartfit.mechanisms.scar import Scar
from heartfit.observation.regional import strain_name
from heartfit.roles import Availability, Delay, Mechanism

PERIOD = 0.8
TIMES = np.arange(1, 20) * PERIOD / 20
FOLLOWED = 12
LIBRARY = [Candidate.from_mechanism(kind) for kind in (Scar, DelayedActivation)]
FIRST, LATE = NAMES.index("segment.01"), NAMES.index("delay.01")


@dataclass
class EvenWall:
    """Segments that shorten by one pulse, weaker where bridges are lost and later where the wave is late.

    Long time steps shift the strain.
    """

    simulations: int = 0
    tangents: int = 0
    shift: float = 0.0
    longer: float = 0.02
    times: dict[str, Floats] = field(default_factory=dict)
    base = COORDINATES

    def near(self, x: Floats, effects: Sequence[Mechanism] = ()) -> None:
        """No other model."""

    def predict(self, x: Floats, effects: tuple[Mechanism, ...] | list[Mechanism] = ()) -> Floats | None:
        self.simulations += 1
        kept = np.exp(CONTRACTILITY_SD * x[FIRST : FIRST + FOLLOWED])
        late = ACTIVATION_SD * x[LATE : LATE + FOLLOWED]
        for effect in effects:
            kept *= 1.0 - effect.lost_share()[1 : FOLLOWED + 1] if isinstance(effect, Availability) else 1.0
            late = late + (effect.delay()[1 : FOLLOWED + 1] if isinstance(effect, Delay) else 0.0)
        phase = np.pi * np.mod(TIMES - late[:, None], PERIOD) / PERIOD
        strain = self.shift - 0.18 * np.exp(0.2 * x[0]) * kept[:, None] * np.sin(phase) ** 2
        return np.concatenate([1.5e-4 * (1.0 + 1.5 * strain.mean(axis=0)), strain.ravel()])

    def with_long_steps(self) -> "EvenWall":
        return replace(self, simulations=0, shift=self.longer)

    def slopes(
        self, x: Floats, effects: list[Mechanism] | tuple[Mechanism, ...] = ()
    ) -> tuple[Floats, Floats]:
        self.tangents += 1
        step = 1e-4 * np.eye(x.size)[: len(NAMES)]
        predicted = self.predict(x, effects)
        return predicted, np.column_stack([(self.predict(x + s, effects) - predicted) / 1e-4 for s in step])


@dataclass
class Measured:
    """Volume and strain of twelve segments with independent noise."""

    values: Floats
    has_pressure: bool = False

    def data(self) -> Data:
        volume = Block("lv_volume", "m^3", TIMES, PERIOD, Noise((1e-6,), 0.0, 0.0, 2e-6))
        strains = (
            Block(strain_name("circumferential", s), "1", TIMES, PERIOD, Noise((0.01,), 0.0, 0.004, 0.02))
            for s in range(1, FOLLOWED + 1)
        )
        return Data(self.values, (volume, *strains))


@cache
def searched(effect: Mechanism | None, seed: int) -> WallFindings:
    """Search a wall that varies naturally, with noise and one effect or none."""
    return search_of(EvenWall(), [effect] if effect else [], seed)


def search_of(wall: EvenWall, effects: list[Mechanism], seed: int) -> WallFindings:
    """Search this wall."""
    rng = np.random.default_rng(seed)
    x = np.zeros(len(NAMES))
    x[[0, *range(FIRST, FIRST + FOLLOWED), *range(LATE, LATE + FOLLOWED)]] = rng.standard_normal(
        1 + 2 * FOLLOWED
    )
    noise = np.concatenate(
        [1e-6 * rng.standard_normal(TIMES.size), 0.01 * rng.standard_normal(FOLLOWED * TIMES.size)]
    )
    return search_wall(wall, Measured(wall.predict(x, effects) + noise), LIBRARY)


@pytest.mark.parametrize("seed", range(6))
def test_a_sound_wall_has_no_name(seed: int) -> None:
    assert searched(None, seed).decision.verdict == "none"


@pytest.mark.parametrize(
    ("angle", "seed"), [(0.2, 10), (1.2, 11), (2.4, 12), (3.6, 13), (4.6, 14), (5.8, 15)]
)
def test_a_scar_is_named_where_it_is(angle: float, seed: int) -> None:
    findings = searched(Scar(extent=0.24, angle=angle), seed)
    assert (findings.decision.verdict, findings.decision.effects) == ("named", ("Scar",))
    assert findings.log_bayes_factor("Scar") > 10.0
    singles = findings.survey.singles
    error = np.angle(np.exp(1j * (most_probable_angle(singles, "Scar") - angle)))
    assert abs(error) < np.deg2rad(30.0)
    probability = probability_of_segments(singles, "Scar")[:FOLLOWED]
    weights = territory_weights(angle, 0.24)[1 : FOLLOWED + 1]
    affected, sound = probability[weights > 0.5], probability[weights == 0.0]
    assert affected.mean() > 2.0 * sound.mean()
    assert sound.max() < 0.5


def test_a_late_wall_is_no_scar() -> None:
    findings = searched(DelayedActivation(lateness=0.1, angle=3.5, share=0.5), 20)
    assert findings.decision.effects == ("DelayedActivation",)


def test_a_misfit_of_no_mechanism_is_unknown() -> None:
    """The volume alone swings, which no strain follows."""
    wall, x = EvenWall(), np.zeros(len(NAMES))
    values = wall.predict(x)
    values[: TIMES.size] += 6e-6 * np.sin(4.0 * np.pi * TIMES / PERIOD)
    findings = search_wall(wall, Measured(values), LIBRARY)
    assert findings.decision.verdict == "unknown"


def test_an_effect_that_was_not_fitted_has_no_evidence() -> None:
    assert searched(None, 0).log_bayes_factor("AorticStenosis") == -np.inf


def test_a_baseline_that_does_not_beat_is_an_error() -> None:
    class Stopped(EvenWall):
        def slopes(self, x: Floats, effects: object = ()) -> None:  # type: ignore[override]
            return None

    measured = Measured(np.zeros((1 + FOLLOWED) * TIMES.size))
    with pytest.raises(InputError, match="wall search: the beat of the baseline fails"):
        search_wall(Stopped(), measured, LIBRARY)


def test_effects_are_ranked_without_the_error_of_long_steps() -> None:
    shifted, exact = (search_of(EvenWall(longer=longer), [], 3).screened for longer in (0.02, 0.0))
    assert [one.effect for one in shifted] == [one.effect for one in exact]
    gains = np.array([[one.log_bayes_factor for one in screened] for screened in (shifted, exact)])
    np.testing.assert_allclose(gains[0], gains[1], atol=1e-6)


@pytest.mark.parametrize(("stiffer", "tangents"), [(0.0, 1), (3.0, 2)])
def test_slopes_are_renewed_while_the_fit_moves(stiffer: float, tangents: int) -> None:
    wall, x = EvenWall(), np.zeros(len(NAMES))
    x[0] = stiffer
    search_wall(wall, Measured(wall.predict(x)), LIBRARY)
    assert wall.tangents == tangents


def test_a_fit_that_has_no_slopes_is_approached_by_half() -> None:
    """The first fit is too far for derivatives; the search goes on from the middle of the way, and names the scar."""

    points: list[Floats] = []

    class Fragile(EvenWall):
        def slopes(self, x: Floats, effects: object = ()) -> tuple[Floats, Floats] | None:  # type: ignore[override]
            points.append(x)
            return None if len(points) == 2 else super().slopes(x, ())

    findings = search_of(Fragile(), [Scar(extent=0.24, angle=1.2)], 11)
    start, first, second = points[:3]
    np.testing.assert_allclose(second, (start + first) / 2.0)
    assert findings.decision.effects == ("Scar",)


def test_the_best_fit_of_each_effect_leads_its_others() -> None:
    """A worse fit of the best effect stands behind another effect, and does not draw the best one there."""
    findings = searched(Scar(extent=0.24, angle=1.2), 11)
    best, late = (
        findings.survey.singles[0],
        replace_evidence(findings.survey.singles[0], "DelayedActivation", 5.0),
    )
    worse = replace_evidence(best, "Scar", 10.0)
    mixed = replace(findings, survey=replace(findings.survey, singles=(best, late, worse)))
    assert list(mixed.gains) == ["Scar", "DelayedActivation"]
    assert mixed.regional == "Scar"
    assert mixed.best("Scar") is best


def replace_evidence(single: Explanation, effect: str, less: float) -> Explanation:
    """The explanation under the name of an effect, with less evidence."""
    hypothesis = replace(single.fit.hypothesis, effects=(effect,))
    posterior = replace(single.posterior, log_evidence=single.log_evidence - less)
    return Explanation(replace(single.fit, hypothesis=hypothesis), posterior)
