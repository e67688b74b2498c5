"""Mutants of what judges a name: the halves of a recording, and predictions of held-out data."""

from tests.mutations.mutant import changes

HALVES = "tests/discovery/refit/test_halves.py"
HELD_OUT = "tests/discovery/sphere_model/test_held_out.py"
PREDICTION = "tests/discovery/sphere_model/test_prediction.py"
RECORDING_HALVES = "tests/discovery/sphere_model/test_halves_of_a_recording.py"

HELD_OUT_MUTANTS = (
    *changes(
        "discovery/sphere_model/held_out.py",
        HELD_OUT,
        ("every cause helps on held-out data", "return self.log_likelihood_gain() > 0.0", "return True"),
        ("a cause gains where it predicts worse", "return extended - baseline", "return baseline - extended"),
    ),
    *changes(
        "discovery/inference/error_ratio.py",
        "tests/discovery/inference/test_error_ratio.py",
        (
            "the error ratio upside down",
            "np.sqrt(squares[1] / squares[0])",
            "np.sqrt(squares[0] / squares[1])",
        ),
        ("an interval of 68 %", "LEVEL = 0.95", "LEVEL = 0.68"),
        (
            "neighbouring errors count as independent",
            "np.mean(CORRELATIONS[:, None, None] ** (2.0 * lags), axis=(1, 2))",
            "np.full(20, 1.0 / steps.size)",
        ),
        ("the noise of both errors counts twice", "(1.0 - shared) * stdtrit", "stdtrit"),
        (
            "segments count as independent",
            "return float(np.clip(trace**2",
            "return float(segments + 0.0 * np.clip(trace**2",
        ),
    ),
    *changes(
        "discovery/sphere_model/held_out.py",
        PREDICTION,
        (
            "unseen samples are predicted without the cause",
            "extension(model).forward(extended)",
            "hypothesis(model).forward(baseline)",
        ),
        (
            "another condition keeps the loading",
            "exp(sd * z) for (path, sd), z",
            "exp(0.0 * z) for (path, sd), z",
        ),
        (
            "another condition keeps the heart rate",
            "paced = nominal.at_period(data.blocks[0].period)",
            "paced = nominal",
        ),
    ),
)

RECORDING_MUTANTS = changes(
    "discovery/sphere_model/recording.py",
    RECORDING_HALVES,
    (
        "the half that is searched judges",
        "held = {name: self.curves[name].part(~mask)",
        "held = {name: self.curves[name].part(mask)",
    ),
    (
        "the search sees all samples",
        "fitted = {name: self.curves[name].part(mask)",
        "fitted = {name: self.curves[name]",
    ),
    (
        "neighbouring samples of pressure judge",
        "return np.floor(samples.times / BLOCK).astype(int) % 2 == 0",
        "return np.arange(samples.times.size) % 2 == 0",
    ),
    ("a short recording is judged by itself", "return self, None", "return self, self"),
)

DIAGNOSIS_MUTANTS = changes(
    "discovery/sphere_model/diagnose.py",
    RECORDING_HALVES,
    (
        "the whole recording is searched",
        "recording, unseen = recording.halves()",
        "unseen = recording.halves()[1]",
    ),
) + changes(
    "discovery/sphere_model/searched_recording.py",
    RECORDING_HALVES,
    ("the size of all samples is that of one half", "self.recording.merged(self.unseen)", "self.recording"),
)

HALF_MUTANTS = changes(
    "discovery/refit/target.py",
    HALVES,
    (
        "the target holds the held-out samples too",
        "return self._target(self.split.fitted)",
        "return self._target(self.split.complete())",
    ),
    (
        "the final size forgets the half that judged",
        "return self._target(self.split.complete())",
        "return self._target(self.split.fitted)",
    ),
    (
        "the search of a study sees all samples",
        "return self._recording(fitted | right), self._recording(held)",
        "return self.recording(), self._recording(held)",
    ),
    (
        "the half that chose a name judges it",
        "return self._recording(fitted | right), self._recording(held)",
        "return self._recording(fitted | right), self._recording(fitted)",
    ),
    (
        "fitted and held-out half swapped",
        "return samples.part(first), samples.part(~first)",
        "return samples.part(~first), samples.part(first)",
    ),
    (
        "a model without roughness",
        "return rough + frame_noise(curve) ** 2 * np.eye(times.size)",
        "return frame_noise(curve) ** 2 * np.eye(times.size)",
    ),
    (
        "frames that judge tell the noise of a second reading",
        "fitted_mask(second.times.size)",
        "np.ones(second.times.size, dtype=bool)",
    ),
    ("a second reading adds no noise", "return rough + read_twice.covariance(times)", "return rough"),
)

JUDGING_MUTANTS = (*HELD_OUT_MUTANTS, *RECORDING_MUTANTS, *DIAGNOSIS_MUTANTS, *HALF_MUTANTS)
