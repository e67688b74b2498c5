"""A row gives the limit in the printed unit, or states that there is none."""

from dataclasses import replace

from heartfit.discovery.sphere_model.limits import DetectionLimit
from heartfit.results.limits_table import limits_table
from heartfit.roles import registered
from tests.printed import numbers_in

LEAK = DetectionLimit(
    "MitralRegurgitation", registered()["MitralRegurgitation"].switch(), 1.0, (1.0, 9.0, 20.0, 30.0), 1.5
)
DELAY = replace(LEAK, name="CatheterDelay", switch=registered()["CatheterDelay"].switch(), sign=-1.0)


def test_limits_are_printed_in_their_unit() -> None:
    table = limits_table([LEAK, DELAY, replace(LEAK, name="Scar", least=None)])
    rows = {effect: cells for effect, *cells in table.to_numpy().tolist()}
    assert rows["MitralRegurgitation"] == ["0.23 cm^2", "1.5", "1.0", "9.0", "20.0", "30.0"]
    assert rows["CatheterDelay -"][:2] == ["30 ms", "1.5"]
    assert numbers_in(rows["Scar"][0]) == []
    assert rows["Scar"][1] == "> 4"
