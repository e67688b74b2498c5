"""The measured curves beside the fitted ones."""

import numpy as np

from heartfit.diagnosis.cause import Trace
from heartfit.discovery.data import Data
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.search import Findings
from heartfit.discovery.whitening import Whitening


def traces(findings: Findings, explained: Explanation, data: Data) -> tuple[Trace, ...]:
    """One for each curve; the noise is that of the level which the explanation that is shown makes most probable."""
    none, best = findings.survey.none.fit, explained.fit
    levels = Whitening.of(data).likeliest(data.values - best.predicted)
    parts = zip(data.blocks, data.rows, levels, findings.lacking, strict=True)
    return tuple(
        Trace(
            block.curve,
            block.times,
            data.values[rows],
            none.predicted[rows],
            best.predicted[rows],
            np.sqrt(np.diag(block.noise.covariance(block.times, block.period, block.noise.levels[level]))),
            lacking.mean,
            lacking.sd,
        )
        for block, rows, level, lacking in parts
    )
