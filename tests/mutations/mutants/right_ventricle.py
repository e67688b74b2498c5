"""Mutants of the right ventricle of the search, and of the balance of both sides."""

from tests.mutations.mutant import changes

SIDES = "tests/heart/circulation/test_sides.py"
RIGHT = "tests/discovery/sphere_model/test_right_ventricle.py"
STROKES = "tests/discovery/sphere_model/test_strokes.py"
BALANCE = "tests/synthetic/test_balance.py"
PLANTED = "tests/synthetic/test_ventricles.py"
HIDDEN = "tests/synthetic/test_hidden_ventricles.py"

RIGHT_VENTRICLE_MUTANTS = (
    *changes(
        "roles/sides.py",
        SIDES,
        ("blood leaves no compartment", "inflow[upstream] -= mean", "inflow[upstream] -= 0.0 * mean"),
        ("a beat counts its first sample twice", "np.mean(flow[1:])", "np.mean(flow)"),
        ("a delay of the right wall acts on the left one", 'kind.amends.startswith("right.")', "False"),
    ),
    *changes(
        "roles/sides.py",
        RIGHT,
        (
            "what the lung receives is not balanced",
            'inflow["pulmonary_artery"] + inflow["left_atrium"]',
            'inflow["aorta"] + inflow["left_atrium"]',
        ),
    ),
    *changes(
        "discovery/sphere_model/recording.py",
        RIGHT,
        (
            "the balance judges, too",
            "replace(self, curves=held, balanced=False)",
            "replace(self, curves=held)",
        ),
    ),
    *changes(
        "discovery/sphere_model/nominal_heart.py",
        RIGHT,
        (
            "the right ventricle has the size of the left one",
            'recording.end_diastolic_volume("rv_volume") / self.right.filled',
            "recording.end_diastolic_volume() / self.right.filled",
        ),
        ("the images of the right ventricle are exact", "return self.gain * values", "return values"),
    ),
    *changes(
        "discovery/sphere_model/strokes.py",
        STROKES,
        ("right images have no gain", "GAIN_SD * right", "0.0 * right"),
    ),
    *changes(
        "synthetic/hidden_ventricles.py",
        HIDDEN,
        ("a rough size balances the sides", "SIZE_RATIO, SIZE_TOLERANCE)", "SIZE_RATIO, 0.3)"),
    ),
    *changes(
        "synthetic/balance.py",
        BALANCE,
        ("the balance is sought on the wrong side", "at_value < 0.0", "at_value > 0.0"),
    ),
    *changes(
        "synthetic/ventricles.py",
        PLANTED,
        (
            "nothing balances a planted heart",
            "self._balance(wall, heart, _with_right_pressure, PRESSURE_TOLERANCE)",
            "heart",
        ),
        ("nothing balances a planted effect", "if self.balanced and effects:", "if False:"),
    ),
)
