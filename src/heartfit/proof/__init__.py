"""A named cause is proved in three dimensions: the model extended by it, refitted, judged by what was never fitted."""
