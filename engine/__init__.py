"""The engine: arrays, textures, brushes, the sparse pyramid and paintings.  Imports no window toolkit."""

import os
from pathlib import Path

import platformdirs


def _compiled_kernels_folder() -> str:
    """A folder of the user's own for compiled kernels: numba reads its cache with pickle, so nobody else may write there."""
    folder = Path(platformdirs.user_cache_dir("inkfall")) / "kernels"
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    return str(folder)


os.environ.setdefault("NUMBA_CACHE_DIR", _compiled_kernels_folder())
