"""Mutants of circulation: branches, loads, waves, circuit."""

from tests.mutations.mutant import changes

CIRCULATION = "tests/heart/circulation"
COMPILED = "tests/heart/sphere/test_simulation.py"

CIRCULATION_MUTANTS = (
    *changes(
        "heart/circulation/elements.py",
        f"{CIRCULATION}/test_windkessel.py",
        ("no run-off", "/ (1.0 + dt / tau), (q_L", ", (q_L"),
        ("venous pressure dropped", "(inflow + P_ve / R_p)", "inflow"),
        ("no inertance", " - Z_c * q_L / (1.0 + theta)", ""),
    ),
    *changes(
        "heart/circulation/coupling.py",
        "tests/heart/test_later_beats.py",
        ("tangents forgotten after a beat", "self._renewed.get(step.start, self._tangent)", "self._tangent"),
        ("the expected state not used", "coupled.predict(expected)", "coupled.predict()"),
        (
            "tangents of other steps",
            "if tangent and tangent.length == step.effective else",
            "if tangent else",
        ),
    ),
    *changes(
        "roles/laws.py",
        f"{CIRCULATION}/test_valves.py",
        ("valves open backwards", "way = 0 if drop > 0.0 else 2", "way = 0 if drop < 0.0 else 2"),
        (
            "slope of the orifice",
            "(0.5 * drop * drop + SMOOTHING * SMOOTHING) / smooth",
            "(drop * drop + SMOOTHING * SMOOTHING) / smooth",
        ),
        ("blood weighs half", "np.sqrt(2.0 / BLOOD_DENSITY)", "np.sqrt(4.0 / BLOOD_DENSITY)"),
    ),
    *changes(
        "roles/laws.py",
        f"{CIRCULATION}/test_narrowing.py",
        ("a narrowing takes a quarter", "np.sqrt(1.0 + 4.0 * laws", "np.sqrt(1.0 + laws"),
        (
            "a narrowed orifice as wide",
            "self.area / np.sqrt(1.0 + inverse_square",
            "self.area / np.sqrt(1.0 + 0.0",
        ),
    ),
    *changes(
        "roles/laws.py",
        f"{CIRCULATION}/test_enclosure.py",
        ("a load's slope without its scale", "slope += rise / scale", "slope += rise"),
    ),
    *changes(
        "heart/circulation/enclosure.py",
        f"{CIRCULATION}/test_enclosure.py",
        ("loads pull", "self._step.forces(x) + self._body", "self._step.forces(x) - self._body"),
        (
            "a load of rank none",
            "self._softened = softened / (1.0 + w @ softened)",
            "self._softened = 0.0 * u",
        ),
    ),
    *changes(
        "roles/laws.py",
        f"{CIRCULATION}/test_leaflets.py",
        ("leaflets close at the rate of opening", "1.0 - closing * drop", "1.0 - opening * drop"),
        ("open leaflets stop backflow", "leak - zeta * flow", "leak"),
        ("slope without the motion of the leaflets", "slope + rise * move", "slope + 0.0 * move"),
        (
            "backward slope of open leaflets dropped",
            "leak_slope + zeta * slope, -flow",
            "leak_slope, -flow",
        ),
    ),
    *changes(
        "heart/circulation/network.py",
        f"{CIRCULATION}/test_network.py",
        (
            "coefficients of another time",
            "if self._last is None or self._last[0] != (time, period):",
            "if self._last is None:",
        ),
        (
            "networks of other mechanisms shared",
            "(self.circulation, self.mechanisms) == (other.circulation, other.mechanisms)",
            "self.circulation == other.circulation",
        ),
    ),
    *changes(
        "heart/circulation/network_step.py",
        COMPILED,
        ("no waves in the arteries", "rows[:, 0] += self._arterial", "rows[:, 0] += 0.0"),
    ),
    *changes(
        "heart/circulation/circuit.py",
        f"{CIRCULATION}/test_circuit.py",
        ("compliance forgotten", "residual += storage * (p[j] - system[j, REFERENCE])", "residual += 0.0"),
        ("the full step in any case", "            share *= 0.5\n", ""),
    ),
)
