"""Makes the random device of the C++ library give one number for the rest of a process.

A compiled library that seeds itself from `std::random_device` cannot be told a seed. It calls the one function of
libstdc++ that draws the number; the first bytes of this function, in the memory of this process alone, are replaced by
`return seed`. Meant for a process that does nothing else.
"""

import ctypes
import mmap
import platform
import struct
import sys

DRAW = "_ZNSt13random_device9_M_getvalEv"
"""std::random_device::_M_getval() of libstdc++."""
KNOWN = ("Linux", "x86_64")
RETURN = bytes.fromhex("f30f1efa b8") + b"%b" + bytes.fromhex("c3")  # endbr64; mov eax, seed; ret
WRITABLE, EXECUTABLE = mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC, mmap.PROT_READ | mmap.PROT_EXEC


def answer(library: str, seed: int) -> bool:
    """Let the random device that the shared library calls give the seed, 0 to 2^32 - 1; whether it could be done.

    Where it cannot, on another system than Linux on x86-64, the standard error says so and nothing is changed.
    """
    if (platform.system(), platform.machine()) != KNOWN:
        return _unseeded(f"this is {platform.system()} on {platform.machine()}")
    address = ctypes.cast(getattr(ctypes.CDLL(library), DRAW), ctypes.c_void_p).value or 0
    if not _protect(address, WRITABLE):
        return _unseeded("the system lets no program change its own code")
    code = RETURN % struct.pack("<I", seed)
    ctypes.memmove(address, code, len(code))
    return _protect(address, EXECUTABLE)


def _protect(address: int, allowed: int) -> bool:
    """Whether the memory page that holds the address, and the next, may now be used so."""
    page = address - address % mmap.PAGESIZE
    change = ctypes.CDLL(None).mprotect
    change.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int]
    return bool(change(page, 2 * mmap.PAGESIZE, allowed) == 0)


def _unseeded(reason: str) -> bool:
    sys.stderr.write(f"mesher: not seeded, a second mesh will differ from this one: {reason}\n")
    return False
