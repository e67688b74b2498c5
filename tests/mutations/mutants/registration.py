"""Mutants of the registration: how much its displacements resist bending."""

from tests.mutations.mutant import changes

REGISTRATION_MUTANTS = (
    *changes(
        "imaging/registration/terms.py",
        "tests/imaging/registration/test_terms.py",
        (
            "twice the bending stiffness",
            "return self._stiffness * self._lattice.bending(step)",
            "return 2.0 * self._stiffness * self._lattice.bending(step)",
        ),
    ),
    *changes(
        "imaging/registration/track.py",
        "tests/imaging/registration/test_track.py",
        (
            "twice the stiffness for each square of a voxel",
            "settings.stiffness / unit**2",
            "2.0 * settings.stiffness / unit**2",
        ),
        ("a stiffness in voxels", "settings.stiffness / unit**2", "settings.stiffness / unit"),
    ),
    *changes(
        "imaging/registration/__init__.py",
        "tests/study/test_configuration.py",
        ("twice the stiffness of the settings", "stiffness: float = 4e-9", "stiffness: float = 8e-9"),
    ),
)
