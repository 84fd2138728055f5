"""Declares functions that only kernels call: compiled without what Python would call them by, a third of a small one's
time to compile."""

from __future__ import annotations

from typing import Any

from numba import njit

inner: Any = njit(cache=True, nogil=True, no_cpython_wrapper=True, no_cfunc_wrapper=True)
