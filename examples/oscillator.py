"""Rank the effects that a damped oscillator lacks: the evidence engine without a heart."""

import numpy as np
from scipy.integrate import solve_ivp

import heartfit as hf

times = np.linspace(0.0, 20.0, 81)


def oscillator(omega, gamma, drag=0.0, delay=0.0):
    """Position at the times; drag: quadratic friction; delay: of the clock that stamps the data."""

    def rate(_, state):
        x, v = state
        return v, -(omega**2) * x - 2.0 * gamma * v - drag * v * abs(v)

    solved = solve_ivp(rate, (0.0, 20.0), (1.0, 0.0), dense_output=True, rtol=1e-6)
    return solved.sol(np.clip(times - delay, 0.0, 20.0))[0]


measured = oscillator(1.55, 0.06, drag=0.2) + 0.03 * np.random.default_rng(0).standard_normal(times.size)
base = {"omega": (1.5, 0.1), "gamma": (0.05, 0.02)}  # mean and standard deviation of the priors
result = hf.rank_effects(oscillator, times, measured, base, {"drag": 0.1, "delay": 0.2}, sd=0.03)
print(result.verdict, result.named)
print({name: round(factor, 1) for name, factor in result.ranking.items()})
print({name: [round(size, 3) for size in sizes] for name, sizes in result.sizes.items()})
print(*result.notes or ["no scale decides the ranking"], sep="\n")
