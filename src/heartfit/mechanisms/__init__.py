"""One mechanism per file; the folder is the registry (see :mod:`heartfit.roles`)."""
