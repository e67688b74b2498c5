"""Simulate an adult without and with a leaking mitral valve, and draw both pressure-volume loops."""

import matplotlib.pyplot as plt

import heartfit as hf

heart = hf.adult()
leaking = heart + hf.mechanisms.MitralRegurgitation(area=0.6e-4)
for label, h in (("healthy", heart), ("leaking", leaking)):
    beat = hf.simulate(h)
    print(f"{label}: {beat}")
    plt.plot(beat.volume["lv"] * 1e6, beat.pressure["lv"] / 133.322, label=label)
plt.xlabel("left ventricular volume (mL)")
plt.ylabel("left ventricular pressure (mmHg)")
plt.legend()
plt.savefig("loops.png")
