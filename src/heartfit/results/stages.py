"""The order in which a study makes its tables, so that a run whose numbers moved names what moved first.

Later tables follow from earlier ones: another mesh moves every number of the hearts that rest on it.
"""

import re
from collections.abc import Sequence

from heartfit.results.drift import Move

STAGES = {
    "meshes": r"meshes",
    "registered images": r"\w+_cine_\w+|registration\w*|noise_model\w*|sensors",
    "priors and sensitivities": r"prior|plausibility|selection|bulk_modulus|sensitivity_\w+|sobol",
    "searches": r"discovery|\w+_extension",
}
"""Pattern of the names of the tables of each stage, in the order of the study."""
CALIBRATIONS = "calibrations"
"""Stage of all other tables, before the searches."""
ORDER = [*list(STAGES)[:-1], CALIBRATIONS, *list(STAGES)[-1:]]


def stage_of(table: str) -> str:
    """Return the stage of a study that makes a table."""
    return next((stage for stage, names in STAGES.items() if re.fullmatch(names, table)), CALIBRATIONS)


def first_moves(moves: Sequence[Move]) -> list[Move]:
    """Return the moves of the earliest stage, from which those of later stages may follow."""
    stages = [ORDER.index(stage_of(move.cell[0])) for move in moves]
    return [move for move, stage in zip(moves, stages, strict=True) if stage == min(stages)]
