"""Unscented transform over named parameters: vectors and Gaussians, without a heart."""
