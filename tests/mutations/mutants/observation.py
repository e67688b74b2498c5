"""Mutants of the observation operator and of the periodic curves that it reads."""

from tests.mutations.mutant import changes

OPERATOR = "tests/observation/test_operator.py"
CURVE = "tests/observation/test_curve.py"
ALIGNMENT = "tests/observation/test_alignment.py"

OBSERVATION_MUTANTS = (
    *changes(
        "observation/operator.py",
        OPERATOR,
        ("the slope over the reach of the window", "slope / reach", "slope"),
        (
            "a window longer by two frames",
            "_filter_weights(self.window, self.order)",
            "_filter_weights(self.window + 2, self.order)",
        ),
        (
            "the sign of a rate",
            "float(rate.max()), float(rate.min()))",
            "float(-rate.max()), float(-rate.min()))",
        ),
        (
            "rise and fall change places",
            "float(rate.max()), float(rate.min()))",
            "float(rate.min()), float(rate.max()))",
        ),
        ("rates per beat", "curve.period / self.frames", "1.0 / self.frames"),
        ("a filter that ends with the beat", 'mode="wrap"', 'mode="edge"'),
        ("V_min is the last frame", "return float(values.min())", "return float(values[-1])"),
        ("P_max is the mean", "return float(values.max())", "return float(values.mean())"),
        (
            "data and simulation at frames of their own",
            "curve.resampled(self.frames), curve.period",
            "curve, curve.period",
        ),
        (
            "the extremum of the curve as it is",
            "self.extremum(self.smooth(curve).values)",
            "self.extremum(curve.values)",
        ),
    ),
    *changes(
        "observation/noise_model.py",
        "tests/observation/test_noise_model.py",
        ("a mean unsigned error without bias", "+ bias * math.erf(ratio)", ""),
    ),
    *changes(
        "observation/curve.py",
        CURVE,
        ("time zero moves the wrong way", "times=self.times - start", "times=self.times + start"),
        ("a curve ends with its last sample", "self.values, period=self.period)", "self.values)"),
        (
            "frames in the middle of their intervals",
            "times = np.arange(frames) *",
            "times = (0.5 + np.arange(frames)) *",
        ),
    ),
    *changes(
        "observation/curve.py",
        ALIGNMENT,
        (
            "a beat is late by its earliness",
            "simulated(measured.times + shift)",
            "simulated(measured.times - shift)",
        ),
        (
            "beats of any heart rate are compared",
            "/ simulated.period - 1) > 0.1",
            "/ simulated.period - 1) > 1.1",
        ),
    ),
)
