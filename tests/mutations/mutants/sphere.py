"""Mutants of beats of spheres."""

from tests.mutations.mutant import changes

CIRCULATION = "tests/heart/circulation"
SPHERE = "tests/heart/sphere/test_sphere.py"
COMPILED = "tests/heart/sphere/test_simulation.py"

SPHERE_MUTANTS = (
    *changes(
        "heart/sphere/body.py",
        SPHERE,
        ("fibres without leverage", "viscous + stretch * self._tension()[0]", "viscous + self._tension()[0]"),
        ("radial viscosity's sign", "plane * stretch - 2.0 * radial", "plane * stretch + 2.0 * radial"),
        ("wall does not thin", "slope *= 1.0 + 2.0 * ratio * stretch**-3", "slope *= 1.0"),
    ),
    *changes(
        "heart/sphere/beat.py",
        f"{CIRCULATION}/test_enclosure.py",
        ("nothing presses on spheres", "p[v] += pressure", "p[v] += 0.0 * pressure"),
    ),
    *changes(
        "heart/sphere/simulation.py",
        COMPILED,
        (
            "the next beat overwrites the one before",
            "len(self.heart.spheres)].copy()",
            "len(self.heart.spheres)]",
        ),
    ),
    *changes(
        "heart/sphere/step.py",
        COMPILED,
        (
            "the Windkessel takes the wave for flow",
            "(p[count + v] - waves[n, v] - a) / b",
            "(p[count + v] - a) / b",
        ),
    ),
)
