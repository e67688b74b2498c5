"""The section of the page of verification on the energy of a beat."""

from heartfit.verification.audit_checks import LONG_STEP, USUAL_STEP, Watched, limit_cycle, watched

HEADER = """
## Energy and blood of a beat

First beat of the coarse parametric ventricles, Newton's method carried to the end. Work of the cavity pressures and the
energy of attaching bridges are what is stored and dissipated, and a remainder, which is the error of the time scheme.
The fibres' scheme balances in every step, whatever its length. Bridges turn over many times the work that they do: with
sigma_0 / k_0 above 1 each is torn while it still holds nearly all it was given. That is how the law is written, no
heart's efficiency. The limit cycle is reached in {beats:.0f} beats.

| J | {heads} |
|---|{rules}
"""


def audit_section() -> str:
    """In Markdown: a column for each scheme and step."""
    columns = {
        "10 ms": watched(LONG_STEP),
        "5 ms": watched(USUAL_STEP),
        "10 ms, backward Euler": watched(LONG_STEP, second_order=False),
    }
    head = HEADER.format(
        beats=limit_cycle().diagnostics["beats"], heads=" | ".join(columns), rules="---|" * len(columns)
    )
    found = [_lines(each) for each in columns.values()]
    return head + "".join(_row(name, [lines[name] for lines in found]) for name in found[0])


def _lines(watched: Watched) -> dict[str, float]:
    ledger = watched.audit
    return {
        "work on the blood, left": -ledger.work["lv"],
        "work on the blood, right": -ledger.work["rv"],
        "brought by attaching bridges": ledger.supplied,
        **{f"stored: {name}": energy for name, energy in ledger.stored.items()},
        **{f"dissipated: {name}": energy for name, energy in ledger.dissipated.items()},
        "remainder": ledger.remainder,
    }


def _row(name: str, energies: list[float]) -> str:
    return f"| {name} | {' | '.join(f'{energy:.4f}' for energy in energies)} |\n"
