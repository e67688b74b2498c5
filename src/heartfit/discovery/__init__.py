"""Search for the effect that a model lacks, on a sphere and in three dimensions."""
