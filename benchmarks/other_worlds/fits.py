"""Fit healthy hearts of other simulators with functions inside the equations: python -m benchmarks.other_worlds.fits

Of every file of resources/other_worlds the HEALTHY healthy hearts that are searched alone. Stores
docs/measured/other_worlds_functions.tsv. Four minutes of two cores.
"""

from concurrent.futures import ProcessPoolExecutor

from benchmarks.other_worlds.score import BANK, HEALTHY, PROCESSES, store_table
from heartfit.discovery.sphere_model.earlier import EarlierHeart
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.io.other_worlds import read_other_hearts
from heartfit.results.other_worlds import functions_table
from heartfit.synthetic.other_worlds import OtherHeart, measure


def main() -> None:
    """Fit all hearts and store the table."""
    hearts = [heart for path in sorted(BANK.glob("*.csv")) for heart in read_other_hearts(path)]
    healthy = [heart for heart in hearts if not heart.illness]
    first = [
        heart
        for world in dict.fromkeys(heart.world for heart in healthy)
        for heart in [one for one in healthy if one.world == world][:HEALTHY]
    ]
    with ProcessPoolExecutor(PROCESSES) as pool:
        misfits = list(pool.map(fitted, first))
    store_table(
        "functions", functions_table(list(zip((one.world for one in first), misfits, strict=True))), "fits"
    )


def fitted(heart: OtherHeart) -> dict[str, float]:
    """Return the misfit of the measured heart, over the noise, by curve."""
    recording = Recording.from_curves(measure(heart))
    return EarlierHeart.from_recording(recording).misfit(recording)


if __name__ == "__main__":
    main()
