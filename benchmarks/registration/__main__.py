"""Measure every registration and store docs/measured/registration_*.tsv, in a quarter of an hour.

`--kept` takes the rows that are on disk, as after an interrupted run.
"""

import sys
from functools import lru_cache

from benchmarks.measured_table import store_table
from benchmarks.registration.contrasts import CONTRASTS, USUAL, scanner
from benchmarks.registration.kept import Kept
from benchmarks.registration.methods import METHODS, OURS, Method
from benchmarks.registration.phantom import HEARTS, Known, known_heart
from benchmarks.registration.repeat import digest_on
from benchmarks.registration.row import Row, measured
from benchmarks.registration.tables import contrasts_table, methods_table
from benchmarks.ventricles import FOLDER
from heartfit.imaging.sequence import ImageSequence
from heartfit.synthetic.cine import image_beat


def main(arguments: list[str]) -> None:
    kept = Kept(FOLDER / "registration" / "rows.json", again="--kept" not in arguments)
    methods = {
        family: {
            name: kept.row(f"{family}, {name}", lambda m=method: row(m)) for name, method in named.items()
        }
        for family, named in METHODS.items()
    }
    ours = METHODS["heartfit"][OURS]
    contrasts = {
        contrast: [
            kept.row(f"heart {heart}, {contrast}", lambda c=contrast, h=heart: row(ours, h, c))
            for heart in range(len(HEARTS))
        ]
        for contrast in CONTRASTS
    }
    same = len({digest_on(threads) for threads in (1, 2)}) == 1
    print(f"a motion on one and on two threads: {'the same' if same else 'different'} bytes")
    store_table("registration_methods", methods_table(methods), "benchmarks.registration")
    store_table("registration_contrasts", contrasts_table(contrasts), "benchmarks.registration")


def row(method: Method, number: int = 0, contrast: str = USUAL) -> Row:
    """Errors of a method on a heart under a contrast."""
    heart, sequence = imaged(number, contrast)
    return measured(heart.mesh, heart.motion.resample(sequence.times), lambda: method(sequence, heart.mesh))


@lru_cache(maxsize=1)
def imaged(number: int, contrast: str) -> tuple[Known, ImageSequence]:
    """A heart and its images."""
    heart = known_heart(number)
    return heart, image_beat(heart.mesh, heart.motion, scanner(contrast), seed=number)


if __name__ == "__main__":
    main(sys.argv[1:])
