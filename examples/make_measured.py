"""Make measured.csv: a virtual heart with a leaking mitral valve, as cine MRI and a catheter would measure it.

The heart is not the model of the search: it has orifice valves, steps of first order and scattered parameters.
"""

from pathlib import Path

import numpy as np

import heartfit as hf
from heartfit.synthetic.hidden import draw_hidden


def make(path: Path) -> None:
    """Write the recording, which is the same at every call."""
    hidden = draw_hidden(np.random.default_rng(1))
    leaking = hidden.with_effects([hf.mechanisms.MitralRegurgitation(area=0.6e-4)])
    hf.write_recording(path, hf.measure(leaking.beat(), volume_noise=0.015, seed=1))


if __name__ == "__main__":
    make(Path(__file__).with_name("measured.csv"))
