"""How large each effect must be to show in a volume and a pressure, as a page of the documentation."""

from collections.abc import Iterable

from heartfit.diagnosis.limits import FRAMES, SIZES, Limit
from heartfit.discovery.rules import RULES
from heartfit.tables.planted_table import UNITS

PAGE = """# How large an effect must be to be seen

Written by `heartfit detection-limits`, in some minutes. The smallest effect that a volume of {frames} frames, with
errors of 2 % of the end-diastolic volume, and a pressure are expected to show: a ln Bayes factor of {threshold:g} over
none, whose {count} parameters are free and absorb what they can (`discovery/limit.py`). Medians over an average heart
and others drawn from the priors; one recording scatters about them by some 3. On tuning seeds the search finds what
this says ([decision 19](decisions/019-what-can-be-seen.md)).

{table}
"""


def limits_page(limits: Iterable[Limit], count: int) -> str:
    """The page in Markdown; count: how many parameters are free."""
    head = ["effect", "detection limit", "in scales", *(f"ln BF at {size:g}" for size in SIZES)]
    rows = [head, ["---"] * len(head), *map(_row, limits)]
    table = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    return PAGE.format(frames=FRAMES, threshold=RULES.detected, count=count, table=table)


def _row(each: Limit) -> list[str]:
    sign = {True: "", False: "+" if each.sign > 0.0 else "-"}[each.switch.one_sided]
    scales = f"> {SIZES[-1]:g}" if each.least is None else f"{each.least:.1f}"
    return [f"{each.name} {sign}".strip(), _amplitude(each), scales, *(f"{x:.1f}" for x in each.factors)]


def _amplitude(each: Limit) -> str:
    """In the printed unit; an effect that does not show at the largest size has none."""
    if each.amplitude is None:
        return "not seen"
    unit, factor = UNITS.get(each.switch.unit, (each.switch.unit, 1.0))
    return f"{abs(each.amplitude - (each.switch.off or 0.0)) / factor:.2g} {unit}".strip()
