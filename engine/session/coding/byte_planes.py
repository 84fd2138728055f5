"""Integers as bytes that deflate well: the lowest of all of them first."""

from __future__ import annotations

import numpy as np


def split_bytes(values: np.ndarray) -> np.ndarray:
    """Returns the bytes of integers, the lowest of all of them first: uint8 (bytes, n)."""
    bits = np.ascontiguousarray(values).reshape(-1).view(f"u{values.itemsize}")
    out = np.empty((values.itemsize, bits.size), np.uint8)
    for n, row in enumerate(out):  # several times as fast as to transpose them
        np.copyto(row, bits >> np.uint8(8 * n) if n else bits, casting="unsafe")
    return out


def joined_bytes(parts: np.ndarray, dtype: np.dtype) -> np.ndarray:
    """Returns the integers of which `split_bytes` made bytes: (n,)."""
    bits: np.ndarray = parts[-1].astype(f"u{dtype.itemsize}")
    for row in parts[-2::-1]:
        bits <<= np.uint8(8)
        bits |= row
    return bits.view(dtype)
