"""The order in which a study makes its tables, so that a run whose numbers moved names what moved first.

Later tables follow from earlier ones: another mesh moves every number of the hearts that rest on it.
"""

import re
from collections.abc import Iterable

STAGES = (
    r"meshes",
    r"\w+_cine_\w+|registration\w*|noise_model\w*|sensors",
    r"prior|plausibility|selection|bulk_modulus|sensitivity_\w+|sobol",
    r"(?!discovery$|\w+_extension$)\w+",
    r"discovery|\w+_extension",
)
"""Names of the tables of each stage: meshes, registered images, prior, calibrations with all others, searches."""


def in_order(tables: Iterable[str]) -> list[str]:
    """Return the names of tables by stage of the study, those of a stage by name."""
    return sorted(tables, key=lambda table: (_stage(table), table))


def _stage(table: str) -> int:
    return next(stage for stage, names in enumerate(STAGES) if re.fullmatch(names, table))
