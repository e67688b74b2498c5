"""From the labels of voxels to the closed surface of both ventricles' wall."""
