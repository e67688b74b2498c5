"""One thread for the mesher, because with more of them some meshes in a hundred differ.

The Python package of fTetWild ignores `max_threads`. So oneTBB, which it uses, is limited from outside by its own
`tbb::global_control`, as fTetWild's own program does; see docs/decisions/geometry.md.
"""

import ctypes
import os

CREATE_CONTROL = "_ZN3tbb6detail2r16createERNS0_2d114global_controlE"
"""Symbol of tbb::detail::r1::create(global_control&), which the constructor of the class calls."""
MAX_ALLOWED_PARALLELISM = 0
"""Parameter of tbb::global_control: number of threads at work at a time, the calling one among them."""
NUMBERS_OF_THREADS = ("OMP_NUM_THREADS", "IGL_NUM_THREADS")
"""Variables of the environment that limit the mesher's other libraries; set before they are loaded."""
LIVING_THREADS = "/proc/self/task"


class _GlobalControl(ctypes.Structure):
    """An object of tbb::global_control."""

    _fields_ = (("value", ctypes.c_size_t), ("reserved", ctypes.c_ssize_t), ("parameter", ctypes.c_int))


_CONTROLS: list[_GlobalControl] = []
"""Controls in force: oneTBB keeps their addresses."""


def limit_other_libraries() -> None:
    """Limit the libraries that read the environment when they are loaded."""
    os.environ |= dict.fromkeys(NUMBERS_OF_THREADS, "1")


def limit_threading_blocks(library: str) -> bool:
    """Limit the oneTBB that a shared library uses to the calling thread; return True on success."""
    create = getattr(ctypes.CDLL(library), CREATE_CONTROL, None)
    if create is None:
        return False
    control = _GlobalControl(1, 0, MAX_ALLOWED_PARALLELISM)
    _CONTROLS.append(control)
    create(ctypes.byref(control))
    return True


def living_threads() -> int:
    """Return the number of threads of this process, idle ones of a pool too; 0 where the system does not list them."""
    try:
        with os.scandir(LIVING_THREADS) as threads:
            return sum(1 for _ in threads)
    except FileNotFoundError:
        return 0
