"""Where the nodes of a simulated beat are in the frames of a measurement; a failed beat is a motion without phases."""

from pathlib import Path

import numpy as np

from heartfit.beat import Beat, motion_of
from heartfit.geometry.arrays import Floats
from heartfit.geometry.motion import Motion
from heartfit.io.arrays import read_arrays
from heartfit.io.atomic import replacing
from heartfit.io.meshes import read_motion, write_motion


def write_simulated_motion(path: Path, beat: Beat, times: Floats) -> None:
    """Writes a beat that kept its nodes at times (p,) s after the trigger, as write_motion does."""
    if beat.completed:
        write_motion(path, motion_of(beat).sampled(times))
        return
    with replacing(path) as draft:
        np.savez_compressed(draft, times=np.empty(0), period=beat.period, positions=np.empty((0, 0, 3)))


def read_simulated_motion(path: Path) -> Motion | None:
    """Reads what write_simulated_motion wrote, None of a failed beat; raises InputError for a missing file."""
    return read_motion(path) if len(read_arrays(path, "times")["times"]) else None
