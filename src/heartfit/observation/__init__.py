"""One operator from periodic curves to the numbers a calibration compares, for data and simulation alike."""
