"""Personalise a 3-D electromechanical heart model with the unscented transform."""

import os
from pathlib import Path

from heartfit.core.kernel_cache import kernel_folder

# numba reads it on import
os.environ.setdefault("NUMBA_CACHE_DIR", str(kernel_folder(Path(__file__).parent)))
