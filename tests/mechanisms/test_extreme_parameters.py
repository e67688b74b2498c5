"""Each parameter of each mechanism, four scales from its mean: a beat or a stated failure, no other exception."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.core.parameter import Parameter, parameters_of
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat, failed_beat
from heartfit.heart.finite_elements.body import StepFailed
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.mechanisms.length_dependence import LengthDependence
from heartfit.personalise.run import ventricles
from heartfit.roles import Amendment, Availability, Delay, Mechanism, Relaxation, Stress, registered

LARGEST_DEVIATION = 4.0
"""Standard deviations of the search's prior."""

LEFT, RIGHT = Sphere.from_volumes(80e-6, 130e-6), Sphere.from_volumes(90e-6, 45e-6)
ONE_BEAT = Numerics(time_step=0.01, max_beats=1)
LOADS = np.array([1000.0, 500.0])
KINDS = registered()
MUSCLES = {
    name: kind
    for name, kind in KINDS.items()
    if issubclass(kind, (Amendment, Availability, Delay, Relaxation, Stress))
}


def extreme_values(declared: Parameter) -> Iterator[float]:
    """Values four scales below and above the mean, unbounded and cut off at the lower bound; none without a prior."""
    centre = declared.value if declared.off is None else declared.off
    for x in (-LARGEST_DEVIATION, LARGEST_DEVIATION):
        if declared.scale is not None:
            yield centre + x * declared.scale
        if declared.scale is not None or declared.sd is not None:
            yield declared.at(x)


def extreme_mechanisms(
    kind: type[Mechanism], parameters: Iterable[Parameter]
) -> Iterator[tuple[str, Mechanism]]:
    """The mechanisms that are not refused, with the name and value of the extreme parameter."""
    for declared in parameters:
        for value in dict.fromkeys(extreme_values(declared)):
            try:
                yield f"{kind.__name__}.{declared.name} = {value:g}", kind(**{declared.name: value})
            except InputError:
                continue


def heart_with(mechanism: Mechanism) -> Heart:
    others = tuple(m for m in Heart().mechanisms if type(m) is not type(mechanism))
    return replace(Heart(), mechanisms=(*others, mechanism))


def assert_beat_or_reason(
    kind: type[Mechanism], parameters: Iterable[Parameter], run: Callable[[Heart], Beat]
) -> None:
    count = 0
    for case, mechanism in extreme_mechanisms(kind, parameters):
        heart = heart_with(mechanism)
        try:
            beat = run(heart)
        except InputError:
            continue
        count += 1
        if beat.completed:
            assert all(np.isfinite(curve).all() for curve in beat.signals().values()), case
        else:
            assert beat.reason, case
    assert count > 0


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS.keys())
def test_spheres_beat_or_give_a_reason(kind: type[Mechanism]) -> None:
    assert_beat_or_reason(
        kind, parameters_of(kind), lambda heart: simulate_spheres(heart, [LEFT, RIGHT], ONE_BEAT)
    )


@pytest.mark.parametrize("kind", MUSCLES.values(), ids=MUSCLES.keys())
def test_finite_element_ventricles_beat_or_give_a_reason(
    kind: type[Mechanism], ventricle: VentricularMesh
) -> None:
    """Ventricles with the stress-free reference of this muscle."""
    few = replace(ONE_BEAT, time_step=0.04, cuts=1)

    def run(heart: Heart) -> Beat:
        try:
            body = ventricles(ventricle, heart.muscle, LOADS)
        except StepFailed as failure:
            return failed_beat(str(failure), heart.period, heart.trigger, {})
        return simulate(heart, body, few)

    assert_beat_or_reason(kind, [kind.switch()], run)


@pytest.mark.parametrize("scales", [2.0, LARGEST_DEVIATION])
def test_ventricles_of_steep_length_dependence_beat(scales: float, ventricle: VentricularMesh) -> None:
    """Fibres so short that no bridge is available have zero bridges."""
    heart = Heart() + LengthDependence(strengthening=LengthDependence.switch().at(scales))
    heart = heart.with_parameters({"slope": 0.15})
    beat = simulate(heart, ventricles(ventricle, heart.muscle, LOADS), ONE_BEAT)
    assert (beat.status, beat.reason) == ("completed", "")
