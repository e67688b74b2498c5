"""Registrations on images of a heart whose motion is known: python -m benchmarks.registration

The best known settings of SimpleITK's methods and ours. Stores docs/measured/registration_methods.tsv; four minutes.
"""

import sys
import time
from collections.abc import Callable
from functools import partial

import numpy as np
import pandas as pd

from benchmarks.measured_table import store_table
from benchmarks.registration.carried import carried, nothing
from benchmarks.registration.library import demons, splines
from benchmarks.registration.phantom import Known, known_heart
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.registration.track import FreeForm, track
from heartfit.imaging.sequence import ImageSequence
from heartfit.observation.comparison import compare_motions
from heartfit.observation.operator import VolumeFeatures
from heartfit.observation.shape import motion_shape
from heartfit.synthetic.cine import image_beat
from heartfit.synthetic.scanner import Scanner

Method = Callable[[ImageSequence, VentricularMesh], Motion]
METHODS: dict[str, Method] = {
    "no registration: mesh of end diastole": partial(carried, matching=nothing),
    "SimpleITK demons, fast symmetric: smoothing 1, half and full": partial(
        carried, matching=demons(((2, 40), (1, 30)), 1.0)
    ),
    "SimpleITK demons, fast symmetric: smoothing 0.5, update smoothing 1, half resolution": partial(
        carried, matching=demons(((2, 40),), 0.5, update=1.0)
    ),
    "SimpleITK B-splines, half resolution: 15 mm, near the wall, 60 steps": partial(
        carried, matching=splines(7.5, 60, 0.2)
    ),
    "heartfit: default settings": lambda sequence, mesh: track(sequence, mesh, FreeForm()).motion,
}


def main() -> None:
    heart = known_heart()
    sequence = image_beat(heart.mesh, heart.motion, Scanner(), seed=0)
    rows = []
    for name, method in METHODS.items():
        rows.append(row(name, method, heart, sequence))
        sys.stdout.write(f"{' | '.join(rows[-1].values())}\n")
        sys.stdout.flush()
    store_table("registration_methods", pd.DataFrame(rows), "benchmarks.registration")


def row(name: str, method: Method, heart: Known, sequence: ImageSequence) -> dict[str, str]:
    """Errors of a method: of the observations, of the points, folded tetrahedra, shape at end systole, and its cost."""
    begin = time.process_time()
    registered = method(sequence, heart.mesh)
    cpu = (time.process_time() - begin) / (len(sequence.times) - 1)
    truth = heart.motion.resample(sequence.times)
    both = compare_motions(heart.mesh, truth, registered, {"lv_volume": VolumeFeatures(len(truth.times))})
    shape = motion_shape(heart.mesh, registered)
    mean, most = both.point_error_of_beat
    return {
        "method": name,
        **{f"{key} %": f"{100.0 * value:+.1f}" for key, value in both.observation_errors().items()},
        "points mm": f"{1e3 * mean:.2f}",
        "95 % mm": f"{1e3 * most:.1f}",
        "folded": str(both.folded.max()),
        "shortening %": f"{100.0 * shape.shortening[both.end_systole]:.1f}",
        "twist °": f"{np.degrees(shape.twist[both.end_systole]):.1f}",
        "CPU s a frame": f"{cpu:.2f}",
    }


if __name__ == "__main__":
    main()
