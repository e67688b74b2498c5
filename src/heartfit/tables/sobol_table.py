"""Sobol's indices of the sphere as a table."""

import pandas as pd

from heartfit.sensitivity.sobol import SobolIndices


def sobol_table(indices: SobolIndices) -> pd.DataFrame:
    """One row per parameter: first (S) and total (T) index of every observation, in percent, and how many beats.

    A sphere of an incompressible wall has no bulk modulus: K has no effect on it at all.
    """
    rows = []
    for i, name in enumerate(indices.parameters):
        row: dict[str, object] = {"parameter": name}
        for j, observation in enumerate(indices.observations):
            row[f"{observation} S (%)"] = 100 * float(indices.first[i, j])
            row[f"{observation} T (%)"] = 100 * float(indices.total[i, j])
        row["T +- (%)"] = 100 * float(indices.total_error[i].max())
        row["note"] = "" if indices.total[i].any() else "without effect: the sphere's wall is incompressible"
        rows.append(row)
    beats = indices.samples * (len(indices.parameters) + 2)
    lost = f"; {len(indices.lost)} base samples left out" if indices.lost else ""
    rows.append({"parameter": "beats", "note": f"{beats} beats of {indices.samples} base samples{lost}"})
    return pd.DataFrame(rows)
