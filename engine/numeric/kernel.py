"""Declares kernels: plain functions over arrays that are compiled at their first call, or taken from the cache.

While one runs, other threads do, too.  What it is compiled with stands here and nowhere else; a kernel keeps the type
of the function that it is made of.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
from numba import njit
from numba.extending import register_jitable
from numba.np import linalg

from engine.numeric import lean_compiling

F = TypeVar("F", bound=Callable[..., Any])
Array = np.ndarray
Int = int | np.integer[Any]  # a whole number of any width
Real = float | np.floating[Any]
Low = Any  # what numba and LLVM make of a value, which have no types
# With the first kernel numba loads SciPy's linear algebra, 24 MB, to see whether it is there: no kernel calls it.
linalg.ensure_blas = lambda: None
lean_compiling.leave_out()


def kernel(function: F) -> F:
    """Compiles a function that Python calls."""
    compiled: F = njit(cache=True, nogil=True)(function)
    return compiled


def inner(function: F) -> F:
    """Compiles a function that only kernels call: what Python would call it by is not made, which takes two thirds of a
    small one's time."""
    compiled: F = njit(cache=True, nogil=True, no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)
    return compiled


def inlined(function: F) -> F:
    """Writes a function into each kernel that calls it."""
    compiled: F = njit(inline="always")(function)
    return compiled


def dividing(function: F) -> F:
    """Compiles a function that divides as NumPy does: by zero gives infinity, or what is no number."""
    compiled: F = njit(cache=True, nogil=True, error_model="numpy")(function)
    return compiled


def short(function: F) -> F:
    """Compiles a function that is too short to let other threads run meanwhile."""
    compiled: F = njit(cache=True)(function)
    return compiled


def uncounted(function: F) -> F:
    """Compiles a function that allocates nothing, without counting references: else each array that is read from a
    tuple is counted, for all threads at once, which takes several times as long as the work itself."""
    compiled: F = njit(cache=True, nogil=True, _nrt=False)(function)
    return compiled


def inner_uncounted(function: F) -> F:
    """Compiles such a function that only kernels call."""
    compiled: F = njit(cache=True, nogil=True, _nrt=False, no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)
    return compiled


def forced(function: F) -> F:
    """Writes a function into each kernel that calls it; it stays a Python function, too.  A call left in a loop would
    keep that from being vectorised."""
    registered: F = register_jitable(forceinline=True)(function)
    return registered
