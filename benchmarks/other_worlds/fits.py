"""Fit healthy hearts of other simulators with functions inside the equations: python -m benchmarks.other_worlds.fits

Of every file of resources/other_worlds the HEALTHY healthy hearts that are searched alone. Stores
docs/measured/other_worlds_functions.tsv. Four minutes of two cores.
"""

from concurrent.futures import ProcessPoolExecutor

from benchmarks.other_worlds.score import HEALTHY, PROCESSES, healthy_hearts, simulators, store_of_worlds
from heartfit.discovery.sphere_model.earlier import EarlierHeart
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.results.other_worlds import functions_table
from heartfit.synthetic.other_worlds import OtherHeart, measure


def main() -> None:
    """Fit all hearts and store the table."""
    with ProcessPoolExecutor(PROCESSES) as pool:
        misfits = {path.stem: list(pool.map(fitted, healthy_hearts(path)[:HEALTHY])) for path in simulators()}
    store_of_worlds("functions", functions_table(misfits), "fits")


def fitted(heart: OtherHeart) -> dict[str, float]:
    """Return the misfit of the measured heart, over the noise, by curve."""
    recording = Recording.from_curves(measure(heart))
    return EarlierHeart.from_recording(recording).misfit(recording)


if __name__ == "__main__":
    main()
