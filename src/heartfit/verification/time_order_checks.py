"""The orders that are asked of the time schemes, and their errors at the steps of the study."""

from heartfit.verification.check import AtLeast, Check
from heartfit.verification.time_order import NAMES, errors, orders

SCHEMES = {"backward Euler": (False, 0.9), "second order": (True, 1.8)}
"""Whether of second order, and the least order asked."""

ASKED = tuple(name for name in NAMES if name != "P_max")
USUAL = (85, 170, 340)
"""Steps in a beat of 0.83 s: of 10, 5 and 2.5 ms."""

SECTION = """
## Time schemes

A whole beat of two spheres with the fibres, valves and arteries of the heart; orders between 60 to 117 steps a beat and
six times as many, errors from the second-order scheme at 8000. Peaks are those seen through a Gaussian window of 10 ms:
the solution has kinks where valves open and fibres activate, and the peak of a curve with kinks has no order. Errors at
the usual steps:

| scheme | step, ms | V_min | q_max | q_min | P_max | dP/dt_max | dP/dt_min |
|---|---|---|---|---|---|---|---|
"""


def time_order_checks() -> list[Check]:
    """One row for each scheme and observation."""
    return [
        AtLeast(f"{scheme}: order of {name}", found[name], least, 0.0, "1", "order of the scheme")
        for scheme, (second_order, least) in SCHEMES.items()
        for found in [orders(second_order)]
        for name in ASKED
    ]


def time_order_section() -> str:
    """The part of the page: the errors of both schemes at the usual steps."""
    rows = (
        (scheme, steps, errors(steps, second)) for scheme, (second, _) in SCHEMES.items() for steps in USUAL
    )
    return SECTION + "".join(
        f"| {scheme} | {829.0 / steps:.1f} | {' | '.join(f'{100 * each:.2f} %' for each in off)} |\n"
        for scheme, steps, off in rows
    )
