"""Personalise a 3-D electromechanical heart model with the unscented transform."""

import os
from pathlib import Path

from heartfit.compiled import folder_of_kernels

# numba reads it as it is imported
os.environ.setdefault("NUMBA_CACHE_DIR", str(folder_of_kernels(Path(__file__).parent)))
