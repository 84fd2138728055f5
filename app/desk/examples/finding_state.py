"""What lies on the ground of an example's picture, while it is found: what the engine told, and what was marked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from app.desk.examples.region_state import RADII
from engine.studio.requests import Request
from engine.studio.textures.cut_records import CutFound, FindCut
from engine.texture.mattes.marks import Mark

MARKING = ("keep", "drop")
_POINTS = 2000  # of a mark


@dataclass(slots=True)
class FindingState:
    """`pixels`: of the picture, uint8 RGBA, read-only; `way`: what a stroke says, of MARKING; `radius`: of the stroke,
    in pixels of the picture; `bare`: shown without the ground; `live`: points of the stroke in progress; `found`: what
    was told last; `taking`: it is to be taken as soon as it is done; `fresh`: the example was just added for this."""

    ident: str
    pixels: np.ndarray
    radius: float
    fresh: bool = False
    way: str = "keep"
    bare: bool = False
    marks: list[Mark] = field(default_factory=list)
    undone: list[Mark] = field(default_factory=list)
    live: list[tuple[float, float]] = field(default_factory=list)
    live_keeps: bool = True
    found: CutFound | None = None
    taking: bool = False

    @classmethod
    def of(cls, ident: str, pixels: np.ndarray, fresh: bool) -> FindingState:
        """Begins with a picture."""
        return cls(ident, pixels, max(2.0, float(round(max(pixels.shape[:2]) / 50))), fresh)

    @property
    def size(self) -> tuple[int, int]:
        """Gives width and height."""
        return self.pixels.shape[1], self.pixels.shape[0]

    @property
    def settled(self) -> bool:
        """Tells whether all is found, as it is marked now."""
        return self.found is not None and self.found.pixels is not None and not self.live

    def ask(self, post: Callable[[Request], None]) -> None:
        """Has it found anew."""
        if self.found is not None:
            told = self.found
            self.found = CutFound(self.ident, told.marks, 0.0, told.whole)
        post(FindCut(self.ident, self.pixels, tuple(self.marks), self.bare))

    def hear(self, found: CutFound) -> None:
        """Takes over what the engine tells; of other marks it is of no use."""
        if found.ident == self.ident and found.marks == len(self.marks):
            self.found = found

    def begin(self, keeps: bool) -> None:
        """A stroke begins."""
        self.live, self.live_keeps = [], keeps

    def extend(self, x: float, y: float) -> None:
        """It goes on, in pixels of the picture."""
        if len(self.live) < _POINTS:
            self.live.append((x, y))

    def end(self, post: Callable[[Request], None], kept: bool) -> None:
        """It ends: it is a mark if it is kept."""
        if kept and self.live:
            self.marks.append(Mark(self.live_keeps, tuple(self.live), self.radius))
            self.undone, self.taking = [], False
            self.live = []
            self.ask(post)
        self.live = []

    def step_back(self, post: Callable[[Request], None], back: bool) -> None:
        """Takes the last mark back, or lays it again."""
        of, to = (self.marks, self.undone) if back else (self.undone, self.marks)
        if of:
            to.append(of.pop())
            self.taking = False
            self.ask(post)

    def see(self, post: Callable[[Request], None], bare: bool) -> None:
        """Shows it with the ground, dimmed, or without."""
        if bare != self.bare:
            self.bare = bare
            self.ask(post)

    def scale_radius(self, factor: float) -> None:
        """Sets another size of the stroke."""
        self.radius = round(max(RADII[0], min(RADII[1], self.radius * factor)), 1)
