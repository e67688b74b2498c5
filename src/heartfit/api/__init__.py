"""Functions of ``import heartfit`` that join several rooms of the package; the command line uses them, too."""
