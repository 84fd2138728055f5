"""The engine: arrays, textures, brushes, the sparse pyramid and paintings.  Imports no window toolkit."""

import atexit
import ctypes
import os
import shutil
import sys
import tempfile
from pathlib import Path

import platformdirs

_KEPT = 256 << 20  # bytes of freed memory the process may hold on to
_HEAPS = 2  # for threads: what one that has ended left free is there for others
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
    trim_threshold, top_pad, mmap_threshold, arena_max = -1, -2, -3, -8
    mallopt(arena_max, _HEAPS)
    mallopt(trim_threshold, _KEPT)
    mallopt(top_pad, _KEPT // 8)
    mallopt(mmap_threshold, _BY_ITSELF)


def _kernels_folder() -> str:
    """A folder only the user can write to: compiled kernels are read with pickle.

    Where there is none, one for this process and those that it starts.
    """
    folder = Path(platformdirs.user_cache_dir("inkfall")) / "kernels"
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if _own(folder):
            return str(folder)
    except OSError:  # a home that cannot be written to
        pass
    return _passing_folder()


def _own(folder: Path) -> bool:
    """Tells whether nobody else can write to a folder, as far as the system tells."""
    if not hasattr(os, "getuid"):
        return True
    about = folder.stat()
    return about.st_uid == os.getuid() and not about.st_mode & 0o022


def _passing_folder() -> str:
    """Returns a folder that goes with the process; one that cannot be made where that fails: nothing is kept then."""
    try:
        folder = tempfile.mkdtemp(prefix="inkfall-kernels-")
    except OSError:
        return os.path.join(os.devnull, "kernels")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


_keep_freed_memory()
if "NUMBA_CACHE_DIR" not in os.environ:
    os.environ["NUMBA_CACHE_DIR"] = _kernels_folder()
os.environ.setdefault("NUMBA_CACHE_LOCATOR_CLASSES", "engine.kernel_cache.Locator")
