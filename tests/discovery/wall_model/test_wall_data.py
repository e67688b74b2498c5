"""Data of a wall: what is searched, what ties it together, and what stands alone."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.discovery.inference.data import Whitening
from heartfit.discovery.sphere_model.recording import BALANCE, Recording
from heartfit.discovery.wall_model.wall_data import NOISE_SCALES, SEARCHED, WallRecording
from heartfit.geometry.mesh import VentricularMesh
from heartfit.observation.curve import Curve
from heartfit.observation.shape import cavity_volumes
from tests.observation.test_regional import PERIOD, TIMES, contraction
from tests.observation.test_regional_noise import KNOWN


@pytest.fixture(scope="module")
def recording(ventricle: VentricularMesh) -> WallRecording:
    motion = contraction(ventricle, 0.8, 0.9)
    pressure = Curve(TIMES, 1e3 + 1.5e4 * np.sin(np.pi * TIMES / PERIOD) ** 2, PERIOD)
    curves = {**cavity_volumes(ventricle, motion), "lv_pressure": pressure}
    return WallRecording(Recording.from_curves(curves), ventricle, motion, KNOWN)


def test_regional_curves_follow_the_others(recording: WallRecording) -> None:
    data = recording.data()
    names = [block.curve for block in data.blocks]
    assert names == ["lv_volume", "lv_pressure", BALANCE, "rv_volume", *SEARCHED]
    assert data.independent == 3
    assert all(block.times.size == TIMES.size - 1 for block in data.blocks[4:])


def test_strain_is_that_of_the_motion_over_its_gain(recording: WallRecording) -> None:
    data = recording.data()
    place = [block.curve for block in data.blocks].index("strain_circumferential_07")
    strain = data.values[data.rows[place]]
    assert strain.min() == pytest.approx(0.5 * (0.8**2 - 1.0) / 0.9, rel=1e-6)


def test_a_tenth_of_the_right_stroke_is_the_gain_of_its_images(recording: WallRecording) -> None:
    data = recording.data()
    assert data.structure is not None
    right = data.rows[3]
    variance = np.diag(data.structure)[right]
    assert np.sqrt(variance.max()) == pytest.approx(0.1 * np.ptp(data.values[right]), rel=1e-9)
    assert variance[0] == 0.0
    assert np.linalg.matrix_rank(data.structure[right, right]) == 1


def test_a_heart_without_right_volume_has_neither_its_gain_nor_a_balance(recording: WallRecording) -> None:
    curves = {name: one for name, one in recording.recording.curves.items() if name != "rv_volume"}
    data = replace(recording, recording=replace(recording.recording, curves=curves)).data()
    assert [block.curve for block in data.blocks] == ["lv_volume", "lv_pressure", *SEARCHED]
    assert data.independent == 2


def test_gains_tie_the_strains_and_nothing_else(recording: WallRecording) -> None:
    data = recording.data()
    structure, start = data.structure, data.rows[4].start
    assert structure is not None
    assert not structure[: data.rows[3].start].any()
    assert not structure[:start, start:].any()
    assert np.linalg.eigvalsh(structure[start:, start:]).min() > 0.0
    one, other = (data.rows[4 + k].start + 5 for k in (0, 3))
    assert structure[one, other] > 0.0


def test_the_scale_of_the_learned_noise_is_inferred(recording: WallRecording) -> None:
    data = recording.data()
    whitening, rng = Whitening.from_data(data), np.random.default_rng(3)
    levels = [0] * len(data.blocks)
    for scale in NOISE_SCALES:
        covariance = data.noise_covariance(levels) + scale**2 * data.structure
        residual = np.linalg.cholesky(covariance) @ rng.standard_normal(data.values.size)
        levels_of_blocks, most_probable = whitening.most_probable_levels(residual)
        assert most_probable == scale
        assert len(levels_of_blocks) == len(data.blocks)


def test_without_pressure_nothing_of_it_is_left(recording: WallRecording) -> None:
    alone = recording.without_pressure()
    assert recording.has_pressure
    assert not alone.has_pressure
    assert [block.curve for block in alone.data().blocks][:3] == ["lv_volume", BALANCE, "rv_volume"]
