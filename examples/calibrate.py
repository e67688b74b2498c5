"""Calibrate contractility, peripheral resistance and a leak to a recording, with an own loop over the sigma points."""

from pathlib import Path

import heartfit as hf

recording = hf.read_recording(Path(__file__).with_name("measured.csv"))
heart = hf.adult().scaled_to(recording) + hf.mechanisms.MitralRegurgitation(area=0.3e-4)
prior = heart.prior({"sigma_0": 0.3, "R_p": 0.3, "MitralRegurgitation.area": 0.5})
outcomes = []
for point in hf.sigma_points(prior):
    beat = hf.simulate(heart.with_parameters(point.parameters))
    outcomes.append(hf.observe(beat))  # of a failed beat the reason, which calibrate takes, too
noise = hf.observation_noise(recording, volume_sd=2e-6, pressure_sd=300.0)
posterior = hf.calibrate(prior, outcomes, hf.observe(recording), noise)
print(hf.summary(posterior).to_string(float_format="{:.3g}".format))
for note in posterior.notes:
    print(note)
