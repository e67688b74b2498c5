"""Repeatability of a motion to the bit: `python -m benchmarks.registration.repeat` prints the hash of its bytes."""

import hashlib
import os
import subprocess
import sys

from benchmarks.process import THREADS
from benchmarks.registration.phantom import known_heart
from benchmarks.ventricles import ROOT
from heartfit.imaging.registration.track import FreeForm, track
from heartfit.synthetic.cine import image_beat
from heartfit.synthetic.scanner import Scanner


def digest() -> str:
    """Motion of the first heart, imaged and followed."""
    heart = known_heart(0)
    sequence = image_beat(heart.mesh, heart.motion, Scanner(), seed=0)
    motion = track(sequence, heart.mesh, FreeForm()).motion
    return hashlib.sha256(motion.positions.tobytes()).hexdigest()


def digest_on(threads: int) -> str:
    """The same in a process whose libraries may use so many threads."""
    environment = os.environ | {f"{library}_NUM_THREADS": str(threads) for library in THREADS}
    command = [sys.executable, "-m", "benchmarks.registration.repeat"]
    process = subprocess.run(command, cwd=ROOT, env=environment, check=True, capture_output=True, text=True)
    return process.stdout.strip()


if __name__ == "__main__":
    print(digest())
