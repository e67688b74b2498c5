"""The page of other methods and of coverage, in Markdown."""

import pandas as pd

from heartfit.configuration.spheres import SphereStudy
from heartfit.tables.sphere_coverage import POOLED
from heartfit.tables.text import to_markdown

HEADER = """# What else one could do, and how far intervals can be trusted

Written by `python -m benchmarks.alternatives` from the tables `alternatives` and `coverage_sphere` of a finished
study, which has figures of both, and from two hearts in 3-D.

## The methods

All minimise the same thing, the misfit under the noise R plus the distance from the prior, except those with R
= 0. A method is given the model, the prior, the observations and R, and is judged by the truth. A simulation
counts when the method asks for it; the beat that only shows where an estimate stands does not.

| method | simulations | what it does |
|---|---|---|
| unscented, R = 0 | 2n+1 a step | the paper's step, ringed in the figure; takes the measurement for exact |
| unscented, R > 0 | 2n+1 a step | the same step, which knows the noise |
| simplex, R > 0 | n+2 a step | the same on the corners of a regular simplex: curvature leaks into Cov(X, Z) |
| ensemble smoother | members x 4 | random members moved four times, with noise inflated fourfold (ES-MDA) |
| CMA-ES | 8 or 9 a generation | evolution strategy on the maximum a posteriori; asks for no slope |

Repeated steps start from the original prior every time, about the last estimate, with points half as far out as
before (`heartfit.calibration.iterated`): the data are used once, and the first step is the paper's to the last
digits. CMA-ES is the package cma (BSD-3-Clause), the extra `alternatives`. The package
iterative_ensemble_smoother is under the GPL, so the smoother is our own.

## The hearts

{hearts} spheres of the same law, drawn from the prior, seeded. Their valves, length dependence, trigger and the
parameters that nobody estimates are other than the calibrator's, and the observations have noise: 2.5 % in
V_min, 4 % in rates, 1.5 % in P_max. "Volume": 4 parameters from 3 observations; "volume and pressure": 7 from
6. In 3-D: two volunteers of the cohort on 3k tetrahedra, the same noise without images.

![Error against number of simulations: medians and quartiles](figures/alternatives.png)

## What it says

- **One step is most of the way.** It leaves a sixth to a quarter of the prior's error of the observations,
  whatever R is. That is 2 to 4 %, about the noise itself: a nearer fit is not a better one.
- **Repeating without noise fits the noise.** The observations come nearer, in some hearts they run away, and
  the parameters get worse, from volumes alone worse than the prior: a direction is hardly seen, and noise is
  divided by its small singular value.
- **Repeating with noise is safe and brings little.** The observations come nearer by a third and more, the
  parameters hardly: what is not observed is not found by more simulations.
- **n+2 points** that know the noise start somewhat worse with pressure (9 against 15 simulations) and are level
  with 2n+1 points after a second step, for fewer simulations.
- **The smoother and CMA-ES** need several times as many simulations for the same error of the observations.
  They would pay where the prior is wider than what a line describes.

We would take one unscented step with R > 0. The study keeps R = 0 for the paper's tables, since that is what is
reproduced, and reports the posterior with noise beside it.

"""

COVERAGE = """
## How often the intervals hold the truth

{covered} spheres each, drawn from the prior; intervals of 95 %; shares pooled over the parameters, with exact
intervals of Clopper and Pearson in which a heart is one trial. "unknown": nothing but what is estimated; the
parameters held fixed as well (8 %); the model as well. R_fixed is the covariance that parameters held fixed
cause in the observations (`heartfit.calibration.fixed`). Errors are those of
the estimates in posterior deviations.

"""

END = """
- **With R = 0 intervals are too short**: they take the measurement for exact. The directions that are hardly
  seen pay for it: c_1 from volumes, k_RS and R_p from volumes and pressure.
- **With R of the measurement they are right on the whole**, even where parameters held fixed scatter by 8 %.
  That scatter is not small: from volumes alone it moves the observations by 4 to 6 %, as much as the noise; with
  pressure, where k_RS, k_ATP and alpha are estimated, by less than 1 %. But most of an interval is prior in a
  direction that the observations hardly see, and R_fixed adds little to that.
- **R_p and k_RS from volumes and pressure** are held somewhat less often after one step, for the model is curved:
  a second step mends it. Where the model is another, R_p stays below: that is a bias, which no R knows of. The
  table `coverage_sphere` has each parameter.
- These hearts scatter as the prior says. Nothing here speaks for hearts outside of it.
"""


def page(race: pd.DataFrame, shares: pd.DataFrame, spheres: SphereStudy) -> str:
    """The page: what the methods are, where they stand, and how often intervals hold the truth.

    race, shares: as `race_table` and `sphere_coverage_table` make them.
    """
    pooled = shares[shares["parameter"] == POOLED].drop(columns=["parameter", "hearts"])
    return "".join(
        [
            HEADER.format(hearts=spheres.hearts),
            to_markdown(race),
            COVERAGE.format(covered=spheres.covered),
            to_markdown(pooled),
            END,
        ]
    )
