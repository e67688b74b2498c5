"""Mutants of planted hearts: size and sign of an effect, errors of a recording, and sealed effects."""

from tests.mutations.mutant import changes

SYNTHETIC = "tests/synthetic"
ERRORS = f"{SYNTHETIC}/test_errors_of_a_recording.py"
SEALED = f"{SYNTHETIC}/test_hidden_effects.py"

PLANTING_MUTANTS = (
    *changes(
        "synthetic/hidden.py",
        ERRORS,
        (
            "half the noise of a planted volume",
            "error = protocol.noise * float(true.values.max())",
            "error = 0.5 * protocol.noise * float(true.values.max())",
        ),
        (
            "half the noise of a planted pressure",
            "samples = true(times) + noise * PRESSURE_NOISE *",
            "samples = true(times) + 0.5 * noise * PRESSURE_NOISE *",
        ),
        (
            "errors of frames shrink with their memory",
            "np.sqrt(1.0 - memory**2) * error[i]",
            "(1.0 - memory) * error[i]",
        ),
        ("errors of frames without memory", "memory * error[i - 1] +", "0.0 * error[i - 1] +"),
        (
            "a discrepancy that grows with its harmonics",
            "np.sqrt(weight / weight.sum())",
            "np.sqrt(weight)",
        ),
        (
            "legs are raised in the answer only",
            "pressure = factor * self.heart.circulation.left_atrium",
            "pressure = self.heart.circulation.left_atrium",
        ),
        (
            "deviates of the answer are not the heart's",
            "{name: np.exp(sd * deviates[name]) for name, sd in RELATIVE.items()}",
            "{name: np.exp(sd * normal()) for name, sd in RELATIVE.items()}",
        ),
    ),
    *changes(
        "synthetic/campaign.py",
        f"{SYNTHETIC}/test_case.py::test_both_signs_are_drawn_where_there_are_two",
        ("the sign of a planted amplitude is dropped", "switch.at(sign * scales)", "switch.at(scales)"),
        (
            "an amplitude of known sign turns negative",
            "sign = 1.0 if switch.one_sided else",
            "sign = 1.0 if False else",
        ),
    ),
    *changes(
        "synthetic/campaign.py",
        f"{SYNTHETIC}/test_admissible.py",
        ("every effect is planted at one scale", "switch.at(sign * scales)", "switch.at(sign)"),
    ),
    *changes(
        "synthetic/case.py",
        f"{SYNTHETIC}/test_admissible.py",
        (
            "a right ventricle that empties completely",
            'not low <= _ejection_fraction(beat.volume["rv"]) <= high',
            'not low <= _ejection_fraction(beat.volume["rv"])',
        ),
    ),
    *changes(
        "synthetic/case.py",
        f"{SYNTHETIC}/test_planted.py",
        (
            "the planted effect is not in the heart",
            "hidden = healthy.with_effects(planted)",
            "hidden = healthy",
        ),
        (
            "the answer is of another size",
            "effects_of(planted, plan.scales),",
            "effects_of(planted, 0.5 * plan.scales),",
        ),
        (
            "raised legs are recorded at rest",
            "curves[RAISED] = _record(hidden.with_preload(float(rng.uniform(*PRELOAD))), protocol, rng)",
            "curves[RAISED] = _record(hidden, protocol, rng)",
        ),
        (
            "raised legs heal the heart",
            "curves[RAISED] = _record(hidden.with_preload(",
            "curves[RAISED] = _record(healthy.with_preload(",
        ),
    ),
    *changes(
        "synthetic/sealed.py",
        SEALED,
        ("sealed sizes below their range", "rng.uniform(*SIZES)", "rng.uniform(0.0, SIZES[0])"),
        ("effects on sensors are sealed", "if not issubclass(kind, Sensor)", "if kind"),
        ("effects that cannot be seen are sealed", "if is_visible(effect, scales):", "if True:"),
        ("an effect at its limit is visible", "sign * scales / MARGIN", "sign * scales"),
        ("an effect is as visible as its opposite", "sign * scales / MARGIN", "scales / MARGIN"),
    ),
    *changes(
        "synthetic/scanner.py",
        f"{SYNTHETIC}/test_catheter.py",
        ("half the noise of a catheter", "true + zero + self.noise *", "true + zero + 0.5 * self.noise *"),
        ("a catheter without a zero", "true + zero + self.noise *", "true + self.noise *"),
        ("a catheter starts at end diastole", "times + beat.trigger, beat.time", "times, beat.time"),
    ),
)
