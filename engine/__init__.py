"""The engine: arrays, textures, brushes, the sparse pyramid and paintings.  Imports no window toolkit."""

import atexit
import ctypes
import os
import shutil
import sys
import tempfile
from pathlib import Path

import platformdirs

_HEAPS = 2  # for threads: what one that has ended left free is there for others
_TRIM_THRESHOLD, _TOP_PAD, _MMAP_THRESHOLD, _ARENA_MAX = -1, -2, -3, -8
# Bytes of freed memory the process may hold on to, and from which an array is mapped by itself (the largest value the
# C library takes): while there is room, and while there is little.
_ROOMY, _SPARING = (256 << 20, 32 << 20), (32 << 20, 1 << 20)


def _keep_freed_memory() -> None:
    """Has the C library use freed pages again instead of giving them back after every array.

    A fresh page costs a fault, and a view of thirteen planes has 27,000 of them: evaluating it takes 3 to 5 times as
    long when each array starts on fresh pages.  glibc only; elsewhere nothing happens.
    """
    _set({_ARENA_MAX: _HEAPS})
    spare_memory(False)


def spare_memory(sparing: bool) -> None:
    """Has large arrays mapped by themselves, so that their pages go back at once, or freed pages kept again.

    Between blocks in use what they leave piles up to several hundred megabytes.
    """
    kept, by_itself = _SPARING if sparing else _ROOMY
    _set({_TRIM_THRESHOLD: kept, _TOP_PAD: kept // 8, _MMAP_THRESHOLD: by_itself})


def _set(options: dict[int, int]) -> None:
    if not sys.platform.startswith("linux"):
        return
    try:
        mallopt = ctypes.CDLL(None).mallopt
    except (OSError, AttributeError):
        return
    for option, value in options.items():
        mallopt(option, value)


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
