"""Images of a beating heart: where their voxels lie, when they were taken, and what is wrong with them."""
