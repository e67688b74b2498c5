"""Names of image files in the formats of SimpleITK."""

from pathlib import Path

SUFFIXES = (".nii.gz", ".nii", ".nrrd", ".nhdr", ".mha", ".mhd")


def is_image(path: Path) -> bool:
    """Return True for a suffix of a readable image."""
    return path.name.endswith(SUFFIXES)


def stem(path: Path) -> str:
    """Name without its suffix; ".nii.gz" is one suffix."""
    suffix = next((suffix for suffix in SUFFIXES if path.name.endswith(suffix)), "")
    return path.name.removesuffix(suffix)
