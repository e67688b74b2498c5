"""A row says the limit in the printed unit, or that there is none."""

from dataclasses import replace

from heartfit.diagnosis.limits import Limit
from heartfit.mechanism import registered
from heartfit.tables.limits_table import limits_page

LEAK = Limit(
    "MitralRegurgitation", registered()["MitralRegurgitation"].switch(), 1.0, (1.0, 9.0, 20.0, 30.0), 1.5
)
DELAY = replace(LEAK, name="CatheterDelay", switch=registered()["CatheterDelay"].switch(), sign=-1.0)


def test_limits_are_printed_in_their_unit() -> None:
    page = limits_page([LEAK, DELAY, replace(LEAK, name="Scar", least=None)], 23)
    assert "| MitralRegurgitation | 0.23 cm^2 | 1.5 | 1.0 | 9.0 | 20.0 | 30.0 |" in page
    assert "| CatheterDelay - | 30 ms | 1.5 |" in page
    assert "| Scar | not seen | > 4 |" in page
