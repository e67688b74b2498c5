"""Mutants of beats of spheres."""

from tests.mutations.mutant import changes

CIRCULATION = "tests/heart/circulation"
SPHERE = "tests/heart/sphere/test_sphere.py"
COMPILED = "tests/heart/sphere/test_simulation.py"
NEIGHBOURS = "tests/heart/sphere/test_neighbours.py"

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
        "heart/sphere/guess.py",
        NEIGHBOURS,
        ("changes are not carried on", " + 2.0 * changes[0, i] - changes[1, i]", ""),
    ),
    *changes(
        "heart/sphere/neighbours.py",
        NEIGHBOURS,
        ("pressures settle in one beat", "_slow(start) - _slow(end) for", "_slow(start) for"),
        ("walls remember nothing", "for _ in range(2):", "for _ in range(1):"),
        ("the first beat is the limit cycle", "while run.drift > CONVERGED:", "while run.beats < 1:"),
    ),
    *changes(
        "heart/sphere/heart.py",
        NEIGHBOURS,
        ("a neighbour keeps the bridges", "fibres[rows.KEPT] = self._bridges\n        branches", "branches"),
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
