"""The engine: arrays, textures, brushes, the sparse pyramid and paintings.  Imports no window toolkit."""

import ctypes
import os
import sys
import tempfile
from pathlib import Path

import platformdirs

_KEPT = 256 << 20  # bytes of freed memory the process may hold on to
_BY_ITSELF = 32 << 20  # bytes from which an array is mapped by itself (the largest value the C library takes)


def _keep_freed_memory() -> None:
    """Let the C library reuse freed pages instead of giving them back after every array.

    A fresh page costs a fault, and a view of thirteen planes has 27,000 of them: evaluating it takes 3 to 5 times as
    long when each array starts on fresh pages.  glibc only; elsewhere nothing happens.
    """
    if not sys.platform.startswith("linux"):
        return
    try:
        mallopt = ctypes.CDLL(None).mallopt
    except (OSError, AttributeError):
        return
    trim_threshold, top_pad, mmap_threshold = -1, -2, -3
    mallopt(trim_threshold, _KEPT)
    mallopt(top_pad, _KEPT // 8)
    mallopt(mmap_threshold, _BY_ITSELF)


def _compiled_kernels_folder() -> str:
    """A folder only the user can write to: numba reads its cache of compiled kernels with pickle."""
    folder = Path(platformdirs.user_cache_dir("inkfall")) / "kernels"
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except OSError:  # a home that cannot be written to: compiled anew at every start
        return tempfile.mkdtemp(prefix="inkfall-kernels-")
    return str(folder)


_keep_freed_memory()
os.environ.setdefault("NUMBA_CACHE_DIR", _compiled_kernels_folder())
