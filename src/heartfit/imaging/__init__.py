"""Images of a beating heart: voxel grids, checks, registration and segmentation."""
