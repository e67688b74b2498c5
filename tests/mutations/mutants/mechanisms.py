"""Mutants of mechanisms that act on a region of the wall."""

from tests.mutations.mutant import changes

SWITCHED_OFF = "tests/mechanisms/test_mechanisms.py::test_muscle_that_is_switched_off_is_the_same_muscle"

MECHANISM_MUTANTS = (
    *changes(
        "heart/finite_elements/body.py",
        SWITCHED_OFF,
        ("nothing is late on a mesh", "tissue.delays()[reference.segments]", "0.0 * reference.segments"),
        ("nothing is scarred on a mesh", "1.0 - tissue.losses()", "1.0 - 0.0 * tissue.losses()"),
    ),
    *changes(
        "heart/sphere/step.py",
        SWITCHED_OFF,
        (
            "nothing is scarred in a compiled beat",
            "fibres[rows.KEPT, i] * available_fraction(",
            "1.0 * available_fraction(",
        ),
    ),
    *changes(
        "geometry/territory.py",
        "tests/geometry/test_territory.py",
        (
            "a territory does not fade",
            "(_reach(distance, share) - distance) / BORDER",
            "_reach(distance, share) - distance",
        ),
    ),
)
