"""Hidden effects: data of hearts that miss, or have, something the calibrator's model has not, and who finds it."""
