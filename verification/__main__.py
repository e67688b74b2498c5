"""Compare the simulator with closed forms, published results and other programs.

python -m verification                  print all checks, one to two minutes; exits with 1 if one is missed
python -m verification store            the same, and store them with their results in docs/measured
python -m verification robustness       beats of hearts drawn from the prior, stored there, a quarter of an hour
python -m verification reference MESH   effect of the stress-free reference on the beat of a mesh, some minutes
"""

import sys
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from heartfit.core.errors import InputError
from heartfit.io.configuration import read_study
from heartfit.io.meshes import read_prepared_mesh
from heartfit.io.tables import write_measured
from verification.reference import find, reference_table
from verification.robustness import robustness_tables
from verification.tables import MISSED, checks_table, results_tables

STANDARD = Path("config/config.yaml")
MEASURED = Path("docs/measured")


def main(arguments: list[str]) -> int:
    """Print or store the tables that the arguments name; returns 0, 1 for a missed check, 2 for bad input."""
    match arguments:
        case [] | ["store"]:
            checks = checks_table()
            print(checks.to_csv(sep="\t", index=False), end="")
            if arguments:
                store({"checks": checks, **results_tables()}, "verification_", "store")
            return int((checks["verdict"] == MISSED).any())
        case ["robustness"]:
            store(robustness_tables(say=lambda text: print(text, file=sys.stderr)), "", "robustness")
            return 0
        case ["reference", mesh]:
            return print_references(Path(mesh))
    print(__doc__, file=sys.stderr)
    return 2


def store(tables: Mapping[str, pd.DataFrame], prefix: str, argument: str) -> None:
    """Store tables by name, made by the command with this argument."""
    for name, table in tables.items():
        write_measured(MEASURED / f"{prefix}{name}.tsv", table, f"python -m verification {argument}")


def print_references(mesh: Path) -> int:
    """Print the table of stress-free references of a mesh (.vtu) at end diastole."""
    try:
        study, ventricles = read_study([STANDARD]), read_prepared_mesh(mesh)
    except InputError as problem:
        print(f"verification: {problem}", file=sys.stderr)
        return 2
    loads = np.array([study.end_diastolic_pressure.lv, study.end_diastolic_pressure.rv])
    table = reference_table(find(ventricles, loads, study.numerics.numerics()))
    print(table.to_csv(sep="\t", index=False), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
