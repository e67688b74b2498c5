"""The page that shows what mesh and time step still change in the observations."""

from collections.abc import Iterable, Sequence

from heartfit.verification.convergence_of_beat import OBSERVATIONS, Row, coarsest_within

LARGEST = 0.02
USUAL_STEP = 5e-3  # s
MILLILITRE, KILOPASCAL = 1e-6, 1e3
UNITS = (MILLILITRE,) * 3 + (KILOPASCAL,) * 3

HEADER = """# Convergence of the observations

The six numbers that the calibration observes, of the first beat of the setting `physical`, on parametric ventricles
filled with ever more tetrahedra and at ever shorter time steps. All meshes fill the same surface. This page is
written by `python3 study.py convergence`.

## Mesh

At {step:g} ms, {scheme}, and how far each is from the finest mesh:

| tetrahedra | EDV, mL | wall, mL | V_min, mL | q_max, mL/s | q_min, mL/s | P_max, kPa | dP/dt max, kPa/s | min |
|---|---|---|---|---|---|---|---|---|
"""

DEFAULT = """
The coarsest mesh within {largest:g} % of the finest in all six: {coarsest}.

## Time step

Difference from the shortest step of the last scheme on the same mesh:

| tetrahedra | scheme | step, ms | V_min | q_max | q_min | P_max | dP/dt max | min | CPU s |
|---|---|---|---|---|---|---|---|---|---|
"""


def convergence_page(rows: Sequence[Row]) -> str:
    """The page; rows come mesh by mesh, the coarsest first, with the best scheme and the shortest step last."""
    scheme = rows[-1].scheme
    usual = [row for row in rows if row.scheme == scheme and row.time_step == USUAL_STEP]
    found = coarsest_within(usual, LARGEST)
    coarsest = f"{found.size.tetrahedra} tetrahedra" if found else "none"
    return (
        HEADER.format(step=1e3 * USUAL_STEP, scheme=scheme)
        + "".join(_mesh_row(row, usual[-1]) for row in usual)
        + DEFAULT.format(largest=100 * LARGEST, coarsest=coarsest)
        + "".join(_step_row(row, _finest_on(rows, row)) for row in rows)
    )


def _finest_on(rows: Sequence[Row], row: Row) -> Row:
    return [other for other in rows if other.size == row.size][-1]


def _mesh_row(row: Row, finest: Row) -> str:
    values = (row.observed[name] / unit for name, unit in zip(OBSERVATIONS, UNITS, strict=True))
    off = row.beside(finest).values()
    cells = [f"{value:.4g} ({100 * part:+.1f} %)" for value, part in zip(values, off, strict=True)]
    volumes = (f"{volume / MILLILITRE:.1f}" for volume in (row.size.EDV, row.size.wall))
    return _line([str(row.size.tetrahedra), *volumes, *cells])


def _step_row(row: Row, finest: Row) -> str:
    off = (f"{100 * part:+.2f} %" for part in row.beside(finest).values())
    head = (str(row.size.tetrahedra), row.scheme, f"{1e3 * row.time_step:g}")
    return _line([*head, *off, f"{row.cpu_s:.1f}"])


def _line(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |\n"
