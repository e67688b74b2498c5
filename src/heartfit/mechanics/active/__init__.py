"""Active laws, one per file: fibre tension driven by the electrical control."""
