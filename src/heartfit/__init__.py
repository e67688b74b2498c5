"""Personalise a 3-D electromechanical heart model with the unscented transform."""

import os
from pathlib import Path

from heartfit.core.kernel_cache import kernel_folder

if "NUMBA_CACHE_DIR" not in os.environ:  # numba reads it on import; the jobs of a workflow inherit it
    os.environ["NUMBA_CACHE_DIR"] = str(kernel_folder(Path(__file__).parent))
