"""Names for what is new."""

from __future__ import annotations


def free_name(stem: str, taken: set[str]) -> str:
    """`stem` with the first number that is not taken yet."""
    n = 1
    while f"{stem} {n}" in taken:
        n += 1
    return f"{stem} {n}"
