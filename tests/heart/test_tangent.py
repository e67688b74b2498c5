"""Tangent-linear beats agree with differences of converged beats, for every kind of coordinate."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat
from heartfit.heart.circulation.coupling import Tolerances
from heartfit.heart.finite_elements.body import FiniteElementBody
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.heart import Heart
from heartfit.heart.neighbourhood import LoadedHeart, Neighbour, surround
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.tangent import TangentBeat, differentiate
from heartfit.mechanisms.left_atrium import LeftAtrium
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.mechanisms.pericardium import Pericardium
from heartfit.mechanisms.scar import Scar
from tests.conftest import END_DIASTOLIC_PRESSURE

NUMERICS = Numerics(time_step=10e-3, max_beats=20, drift=1e-3)
CONVERGED = replace(
    NUMERICS,
    drift=1e-4,
    keep_positions=True,
    tolerances=Tolerances(force=1e-3, volume=1e-12, pressure=1e-2, iterations=60),
)
SIZE, DIFFERENCE = 0.01, 0.01

NOMINAL = Heart() + MitralRegurgitation(area=2e-6) + Scar(extent=0.1) + Pericardium()
"""A heart with a leak, a scar and a load around it."""


def along(*names: str, shift: float = 0.0) -> Callable[[float], Heart]:
    """Heart whose parameters are multiplied by exp(x), or shifted by ``shift`` times x."""
    paths = [NOMINAL.parameter_path(name) for name in names]
    values = {path: NOMINAL.parameters()[path] for path in paths}
    return lambda x: NOMINAL.with_parameters(
        {path: value + shift * x if shift else value * np.exp(x) for path, value in values.items()}
    )


COORDINATES: dict[str, Callable[[float], Heart]] = {
    "contractility": along("sigma_0"),
    "stiffness": along("c_1", "c_2"),
    "resistance": along("R_p"),
    "leak": along("MitralRegurgitation.area"),
    "activation": along("onset", shift=0.01),
    "scar": along("Scar.extent"),
    "pericardium": along("Pericardium.volume", shift=2e-5),
}
"""Hearts by one coordinate of each kind: muscle, reference, vessels, valves, time, regions and the load around."""
USUAL = list(COORDINATES)[:3]

WITHIN = {"lv_volume": 0.03, "rv_volume": 0.03, "lv_pressure": 0.06, "aorta_pressure": 0.06}
"""Largest root mean square error of a derivative over its own root mean square."""
SMALL = {"volume": 1e-6, "pressure": 60.0, "length": 5e-4}
"""Root mean square derivative below which it is judged by its absolute error [m^3, Pa, m]."""


@pytest.fixture(scope="module")
def tangent(ventricle: VentricularMesh) -> TangentBeat:
    """Derivatives by all coordinates at once."""
    hearts = NOMINAL, *(coordinate(SIZE) for coordinate in COORDINATES.values())
    centre, *others = (LoadedHeart(heart, ventricle, END_DIASTOLIC_PRESSURE) for heart in hearts)
    return differentiate(NOMINAL, *surround(centre, others, SIZE), NUMERICS)


def converged(mesh: VentricularMesh, heart: Heart) -> Beat:
    reference = unload(mesh, heart.muscle, END_DIASTOLIC_PRESSURE)
    return simulate(heart, FiniteElementBody(reference, heart.muscle), CONVERGED)


def lengths(mesh: VentricularMesh, beat: Beat) -> np.ndarray:
    """Lengths (t, m) of one edge of every tetrahedron [m]: the deformation, without the motion as a whole."""
    ends = np.asarray(beat.positions)[:, mesh.tets[:, :2]]
    return np.asarray(np.linalg.norm(ends[:, :, 0] - ends[:, :, 1], axis=-1))


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


@pytest.mark.parametrize(
    "name",
    [*USUAL, *(pytest.param(name, marks=pytest.mark.long) for name in COORDINATES if name not in USUAL)],
)
def test_derivatives_are_those_of_converged_beats(
    ventricle: VentricularMesh, tangent: TangentBeat, name: str
) -> None:
    column = list(COORDINATES).index(name)
    above, below = (converged(ventricle, COORDINATES[name](x)) for x in (DIFFERENCE, -DIFFERENCE))
    for curve, within in WITHIN.items():
        expected = (above.signals()[curve] - below.signals()[curve]) / (2.0 * DIFFERENCE)
        scale = max(rms(expected), SMALL[curve.rsplit("_", 1)[1]])
        assert rms(tangent.signals[curve][:, column] - expected) < within * scale, curve
    expected = (lengths(ventricle, above) - lengths(ventricle, below)) / (2.0 * DIFFERENCE)
    near = (lengths(ventricle, tangent.near(column, x)) for x in (DIFFERENCE, -DIFFERENCE))
    stretched = np.subtract(*near) / (2.0 * DIFFERENCE)
    assert rms(stretched - expected) < 0.03 * max(rms(expected), SMALL["length"])


def test_a_beat_nearby_is_the_first_order_one(tangent: TangentBeat) -> None:
    column = list(COORDINATES).index("activation")
    near = tangent.near(column, 0.5)
    change = near.volume["lv"] - tangent.beat.volume["lv"]
    assert change == pytest.approx(0.5 * tangent.signals["lv_volume"][:, column], abs=1e-12)
    assert near.trigger == pytest.approx(tangent.beat.trigger + 0.01 * SIZE)
    assert near.pressure["left_atrium"] is tangent.beat.pressure["left_atrium"]


def test_a_failing_beat_is_an_error(coarse_body: FiniteElementBody) -> None:
    impossible = replace(NUMERICS, cuts=0, tolerances=Tolerances(iterations=1))
    with pytest.raises(InputError, match=r"tangent: beat 1: .* expected a beat to differentiate"):
        differentiate(Heart(), coarse_body, [], impossible)


@pytest.mark.parametrize(
    ("other", "message"),
    [
        (replace(Heart(), period=0.9), r"neighbour 0 beats in 0.9 s; expected 0.829 s"),
        (Heart() + LeftAtrium(), r"neighbour 0 has 1 atria with a volume; expected 0"),
    ],
    ids=["period", "atrium"],
)
def test_a_neighbour_of_other_equations_is_an_error(
    coarse_body: FiniteElementBody, other: Heart, message: str
) -> None:
    with pytest.raises(InputError, match=message):
        differentiate(Heart(), coarse_body, [Neighbour(other, coarse_body, SIZE)], NUMERICS)
