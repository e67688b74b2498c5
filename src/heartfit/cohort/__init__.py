"""Virtual volunteers: measured data whose truth is known, made by a model that is not the calibrator's."""
