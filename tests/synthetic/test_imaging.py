"""Errors of image sensors act before the scanner, on the imaged motion."""

import numpy as np
import pytest

from heartfit.geometry.mesh import Motion
from heartfit.mechanisms.catheter_offset import CatheterOffset
from heartfit.mechanisms.image_shrinkage import ImageShrinkage
from heartfit.mechanisms.image_trigger_delay import ImageTriggerDelay
from heartfit.synthetic.ventricles import distort_motion

PERIOD = 0.8
TIMES = np.arange(40) * PERIOD / 40


def path(times):
    turn = 2.0 * np.pi * times / PERIOD
    return np.stack([np.cos(turn), np.sin(turn), 0.1 * np.cos(2.0 * turn)], axis=-1)[:, None, :]


MOTION = Motion(TIMES, PERIOD, path(TIMES))


def test_a_delayed_trigger_shows_every_node_at_its_earlier_place():
    late = distort_motion(MOTION, [ImageTriggerDelay(0.05)])
    assert late.positions == pytest.approx(path(TIMES - 0.05))


def test_lost_motion_is_lost_at_every_node():
    half = distort_motion(MOTION, [ImageShrinkage(0.5)])
    assert half.positions == pytest.approx(0.5 * (path(TIMES) + path(TIMES[:1])))


def test_a_catheter_moves_no_image():
    assert distort_motion(MOTION, [CatheterOffset(500.0)]) is MOTION
