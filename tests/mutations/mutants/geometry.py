"""Mutants of cavities and the arrival of the activation."""

from tests.mutations.mutant import changes

ACTIVATION = "tests/heart/activation"
CAVITY = "tests/geometry/test_cavity.py"
EIKONAL = f"{ACTIVATION}/test_eikonal.py"

GEOMETRY_MUTANTS = (
    *changes(
        "geometry/cavity.py",
        CAVITY,
        ("volume's sign", "return six_volumes / 6.0", "return -six_volumes / 6.0"),
        (
            "lids carry no pressure",
            "gradient[rim[i], axis] += gradient[-1 - opening, axis] / size",
            "gradient[rim[i], axis] += 0.0",
        ),
        ("gradient doubled", "gradient[a, i] -= cross / 6.0", "gradient[a, i] -= cross / 3.0"),
    ),
    *changes(
        "heart/activation/eikonal.py",
        EIKONAL,
        ("speed across not squared", "(np.eye(3) - along) / ratio**2", "(np.eye(3) - along) / ratio"),
        ("the earlier root", "(b + np.sqrt(discriminant)) / a", "(b - np.sqrt(discriminant)) / a"),
        (
            "rays from outside",
            "        return np.inf\n    return arrival",
            "        return arrival\n    return arrival",
        ),
    ),
)
