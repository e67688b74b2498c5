"""From a recording of a heart to the named cause of what its simulation gets wrong, on a sphere of the same law."""
