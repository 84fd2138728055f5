"""The region of an example as the window knows it: what the engine told of it, and with what it is painted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from immutables import Map

from engine.studio.requests import Request
from engine.studio.textures.texture_requests import RegionDo, RegionTravel
from engine.studio.textures.texture_results import RegionScene

RADII = (0.5, 300.0)
WAYS = ("in", "out", "colour")
EVERYTHING, BY_ALPHA = Map({"all": True}), Map({"alpha": True})
INVERTED, SMOOTHED = Map({"invert": True}), Map({"smooth": True})


@dataclass(slots=True)
class RegionState:
    """`radius`: of the brush, in pixels of the picture; `way`: what a stroke does, of WAYS; `tolerance`: how far a
    colour may be from the one that is clicked, 0..1; `joined`: only what hangs together with it."""

    scene: RegionScene
    radius: float = 12.0
    way: str = "in"
    tolerance: float = 0.1
    joined: bool = True

    @classmethod
    def of(cls, scene: RegionScene) -> RegionState:
        """Returns the state of a region that was opened: of a whole photograph, the background is to be cut out."""
        way = "colour" if scene.opaque and scene.inside.all() else "in"
        return cls(scene, max(2.0, float(round(max(scene.size) / 20))), way)

    def do(self, post: Callable[[Request], None], step: Map[str, Any]) -> None:
        """Takes a step."""
        post(RegionDo(self.scene.ident, step))

    def travel(self, post: Callable[[Request], None], count: int) -> None:
        """Takes back steps (`count` < 0), or takes them again."""
        post(RegionTravel(self.scene.ident, count))

    def pick(self, post: Callable[[Request], None], x: int, y: int) -> None:
        """Takes everything of the colour at a pixel out of the region."""
        width, height = self.scene.size
        if 0 <= x < width and 0 <= y < height:
            self.do(post, self._without((x, y)))

    def tolerate(self, post: Callable[[Request], None], tolerance: float, joined: bool) -> None:
        """Sets another tolerance; the colour that was picked just now is picked again with it."""
        if (tolerance, joined) == (self.tolerance, self.joined):
            return
        self.tolerance, self.joined = tolerance, joined
        like = self.scene.steps[-1].get("like") if self.scene.steps else None
        if like is not None:
            post(RegionDo(self.scene.ident, self._without(like["at"]), instead=True))

    def resize(self, factor: float) -> None:
        """Sets another size of the brush."""
        self.radius = round(max(RADII[0], min(RADII[1], self.radius * factor)), 1)

    def _without(self, at: tuple[int, int]) -> Map[str, Any]:
        like = Map({"at": at, "tolerance": self.tolerance, "contiguous": self.joined})
        return Map({"op": "subtract", "like": like})
