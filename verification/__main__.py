"""Print a page of verification.

python -m verification                  all checks, one to two minutes; exits with 1 if a check is missed
python -m verification robustness       beats of hearts drawn from the prior, a quarter of an hour
python -m verification reference MESH   effect of the stress-free reference on the beat of a mesh, some minutes
"""

import sys
from pathlib import Path

import numpy as np

from heartfit.core.errors import InputError
from heartfit.io.configuration import read_study
from heartfit.io.meshes import read_prepared_mesh
from verification.page import MISSED, verification_page
from verification.reference import find, reference_table
from verification.robustness import robustness_page

STANDARD = Path("config/config.yaml")


def main(arguments: list[str]) -> int:
    """Print the page that the arguments name; returns 0, 1 for a missed check, 2 for bad input."""
    match arguments:
        case []:
            page = verification_page()
            print(page, end="")
            return int(MISSED in page)
        case ["robustness"]:
            print(robustness_page(say=lambda text: print(text, file=sys.stderr)), end="")
            return 0
        case ["reference", mesh]:
            return print_references(Path(mesh))
    print(__doc__, file=sys.stderr)
    return 2


def print_references(mesh: Path) -> int:
    """Print the table of stress-free references of a mesh (.vtu) at end diastole."""
    try:
        study, ventricles = read_study([STANDARD]), read_prepared_mesh(mesh)
    except InputError as problem:
        print(f"verification: {problem}", file=sys.stderr)
        return 2
    loads = np.array([study.end_diastolic_pressure.lv, study.end_diastolic_pressure.rv])
    print(reference_table(find(ventricles, loads, study.numerics.numerics())), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
