"""Which parameters the observations see; knows vectors and Gaussians, never a heart."""
