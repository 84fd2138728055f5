"""Benchmarks: each measures a figure and, in the same run, the bound that it is compared with.

A benchmark is a module here with `measure() -> Iterable[Figure]`, and a row in BENCHES.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Figure:
    """One row: `value` in `unit`; `ratio` of it to the bound measured in the same run, which ought to be at most
    `limit` (or at least, where `more_is_better`)."""

    name: str
    value: float
    unit: str
    bound: str
    ratio: float
    limit: float
    more_is_better: bool = False

    @property
    def within(self) -> bool:
        return self.ratio >= self.limit if self.more_is_better else self.ratio <= self.limit


# Name, what it measures.  The module app.bench.<name> does it.
BENCHES = {
    "view": "a 1920 x 1080 view from its parent level, against copying the bytes that it moves",
    "stroke": "a stroke of 1,000 points to committed pixels at all levels",
}
