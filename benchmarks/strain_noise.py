"""Learn the noise of regional strain from sequences of known truth: python -m benchmarks.strain_noise

Hearts of `benchmarks.strain_sequences`. Stores docs/measured/strain_noise.tsv, the noise that all of them teach,
strain_noise_coverage.tsv, how well it describes sequences that did not teach it, and strain_noise_segments.tsv, its
quality in each segment. Ten seconds of one core per sequence; finished sequences are kept.
"""

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from typing import get_args

import numpy as np
import pandas as pd

from benchmarks.measured_table import store_table
from benchmarks.strain_sequences import AFFECTED, SOUND, sequence
from heartfit.core.arrays import Floats
from heartfit.observation.gain_noise import Pattern
from heartfit.observation.regional import BASE_DESCENT, KINDS, names_of_kind, regional_curves
from heartfit.observation.regional_noise import RegionalNoise, RegionalPair, leave_one_out
from heartfit.observation.strain import SEGMENTS

MODULE = "benchmarks.strain_noise"
SOUND_HEARTS = "sound"
ALL_HEARTS = "all"
Judge = Callable[[RegionalNoise, RegionalPair, str], float]


def main() -> None:
    """Make the sequences that are not on disk yet, learn their noise and store the tables."""
    pairs, effects, cpu = acquired()
    noise = RegionalNoise.from_pairs(pairs)
    tables = {
        "strain_noise": parameters_table(noise, cpu),
        "strain_noise_coverage": pd.DataFrame(list(coverage_rows(pairs, effects))),
        "strain_noise_segments": segments_table(pairs, leave_one_out(pairs)),
    }
    for name, table in tables.items():
        store_table(name, table, MODULE)
        sys.stdout.write(f"{table.to_string(index=False)}\n")


def acquired() -> tuple[list[RegionalPair], list[str], float]:
    """Return the curves of all sequences, their effects, and the mean time of one [CPU s]."""
    pairs, effects, times = [], [], []
    for number in range(SOUND + AFFECTED):
        one = sequence(number)
        pairs.append(
            RegionalPair(regional_curves(one.mesh, one.true), regional_curves(one.mesh, one.registered))
        )
        effects.append(one.effect)
        times.append(one.cpu)
        sys.stdout.write(f"{number} {one.effect or SOUND_HEARTS} {one.cpu:.1f} s\n")
        sys.stdout.flush()
    return pairs, effects, float(np.mean(times))


def parameters_table(noise: RegionalNoise, cpu: float) -> pd.DataFrame:
    """One row for each kind of curve: the parameters of its noise, by the symbols of the module of gain noise."""
    rows = []
    for kind, one in noise.kinds.items():
        single = kind == BASE_DESCENT
        rows.append(
            {
                "curve": _printed(kind),
                "G": f"{one.gain:.3f}",
                "sd_g": f"{one.common_sd:.3f}",
                "sd_h": "" if single else f"{one.element_sd:.3f}",
                "s": f"{one.sd:.3g}",
                "unit of s": "m" if single else "1",
                "r": "" if single else f"{one.shared:.3f}",
                "tau (s)": f"{one.memory:.3f}",
                "sequences": one.sequences,
                "CPU s per sequence": f"{cpu:.0f}",
            }
        )
    return pd.DataFrame(rows)


def coverage_rows(pairs: Sequence[RegionalPair], effects: Sequence[str]) -> Iterator[Mapping[str, object]]:
    """Yield a row for each kind, pattern, group of hearts that teach and group that is judged.

    A sequence never teaches the noise that judges it.
    """
    sound = [pair for pair, effect in zip(pairs, effects, strict=True) if not effect]
    for taught, pattern in product((SOUND_HEARTS, ALL_HEARTS), get_args(Pattern)):
        teachers = sound if taught == SOUND_HEARTS else list(pairs)
        by_teacher = dict(zip(map(id, teachers), leave_one_out(teachers, pattern), strict=True))
        of_teachers = RegionalNoise.from_pairs(teachers, pattern)
        judges = [by_teacher.get(id(pair), of_teachers) for pair in pairs]
        for kind in KINDS if pattern == "mean" else KINDS[:2]:
            chi = _each(judges, pairs, kind, RegionalNoise.reduced_chi_square)
            density = _each(judges, pairs, kind, RegionalNoise.log_density)
            mean = _each(judges, pairs, kind, chi_square_of_mean)
            for effect in dict.fromkeys(effects):
                group = np.array(effects) == effect
                yield {
                    "curve": _printed(kind),
                    "gain of a segment acts on": "" if kind == BASE_DESCENT else f"{pattern} strain",
                    "learned from": taught,
                    "judged": effect or SOUND_HEARTS,
                    "hearts": int(group.sum()),
                    "chi-square": f"{chi[group].mean():.2f}",
                    "median": f"{np.median(chi[group]):.2f}",
                    "largest": f"{chi[group].max():.2f}",
                    "of the mean curve": f"{mean[group].mean():.2f}",
                    "ln density": f"{density[group].mean():.3f}",
                }


def segments_table(pairs: Sequence[RegionalPair], judges: Sequence[RegionalNoise]) -> pd.DataFrame:
    """One row for each segment: mean gain and chi-square of its strain in both directions."""
    columns: dict[str, list[str]] = {"segment": [str(segment) for segment in SEGMENTS]}
    for kind in KINDS[:2]:
        curves = [pair.of_kind(kind) for pair in pairs]
        along = np.sum([(one.registered * one.true).sum(axis=1) for one in curves], axis=0)
        weights = np.sum([(one.true**2).sum(axis=1) for one in curves], axis=0)
        white = [judge.whitened(pair, kind) for judge, pair in zip(judges, pairs, strict=True)]
        chi = np.mean(np.square(white).reshape(len(pairs), len(SEGMENTS), -1), axis=(0, 2))
        columns[f"{kind} gain"] = [f"{gain:.2f}" for gain in along / weights]
        columns[f"{kind} chi-square"] = [f"{one:.2f}" for one in chi]
    return pd.DataFrame(columns)


def chi_square_of_mean(noise: RegionalNoise, pair: RegionalPair, kind: str) -> float:
    """Reduced chi-square of the mean over the curves of a kind, to which errors that segments share add up."""
    curves, one = pair.of_kind(kind), noise.kinds[kind]
    shape = (*curves.true.shape, *curves.true.shape)
    covariance = one.covariance(curves.true, curves.times).reshape(shape).mean(axis=(0, 2))[1:, 1:]
    residual = (curves.registered - one.gain * curves.true).mean(axis=0)[1:]
    return float(residual @ np.linalg.solve(covariance, residual)) / residual.size


def _each(judges: Sequence[RegionalNoise], pairs: Sequence[RegionalPair], kind: str, judge: Judge) -> Floats:
    """Judgement (n,) of each pair by its noise."""
    return np.array([judge(noise, pair, kind) for noise, pair in zip(judges, pairs, strict=True)])


def _printed(kind: str) -> str:
    return names_of_kind(kind)[0].replace("_", " ") if kind == BASE_DESCENT else f"{kind} strain"


if __name__ == "__main__":
    main()
