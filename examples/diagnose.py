"""Diagnose a recording: name the mechanism that a simulation of this heart lacks. Takes half a minute."""

from pathlib import Path

import heartfit as hf

recording = hf.read_recording(Path(__file__).with_name("measured.csv"))
diagnosis = hf.diagnose(recording)
print(f"verdict: {diagnosis.verdict}")
for cause in diagnosis.named:
    low, high = cause.interval
    print(f"{cause.name}: {cause.amplitude:.2g} {cause.unit}, 95 % interval {low:.2g} to {high:.2g}")
    print(f"ln Bayes factor over a heart without it: {cause.ln_bayes_factor:.0f}")
for gain in diagnosis.gain:
    print(f"error of {gain.curve} on samples held out from the fit: {gain.ratio:.2f} of that without it")
for line in diagnosis.warnings:
    print(f"check first: {line}")
