"""The unscented transform over named parameters; knows vectors, never a heart."""
