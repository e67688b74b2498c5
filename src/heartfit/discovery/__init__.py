"""Which effect a model lacks, from the residual of curves; knows vectors, never a heart."""
