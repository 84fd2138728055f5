"""What the dabs of a stroke look like, to those who lay them: the interface of `tip.Pattern` and `prints.Oval`."""

from __future__ import annotations

from typing import Protocol

import numpy as np

TwoInts = tuple[int, int]
Plane = np.ndarray
Planes4 = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]


class Print(Protocol):
    """What dabs look like."""

    def lay(self, coverage: Plane, discs: np.ndarray, which: np.ndarray, count: TwoInts, corner: TwoInts) -> None:
        """Lays the discs `which` into a tile's coverage, as `Pattern.lay`."""
        ...

    def lay_tinted(
        self, planes: Planes4, discs: np.ndarray, which: np.ndarray, count: TwoInts, corner: TwoInts
    ) -> None:
        """As `lay`, each disc with its tints, its last columns.  `planes`: coverage, and zeros, (128, 128) each; tints
        (n, 128, 128); where textures lie, by six columns before the tints, (2, 128, 128), or none (0, 128, 128)."""
        ...

    def of_copy(self, number: int) -> Print:
        """Returns what the dabs of one copy alone look like; 0: of the stroke itself."""
        ...
