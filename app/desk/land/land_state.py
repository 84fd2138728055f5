"""The painting seen as land: where the eye is and goes, which tiles are held, which picture at rest."""

from __future__ import annotations

import math
from collections import OrderedDict
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from engine.numeric.address import Rect
from engine.painting.outlook import Outlook
from engine.studio.land.land_records import StillCome
from engine.terrain.seen.choosing import FINEST, LandSight
from engine.terrain.seen.eye import Eye, as_fraction, place_kept
from engine.terrain.seen.land_tiles import LandTile, TileKey
from engine.terrain.seen.meeting import Hit, ground_under, met

MOST_HELD = 32 << 20  # bytes of tiles: those of a view are 13 to 48 MB; the picture at rest takes up to 210 MB beside
LEAST_TEXEL, FIRST_TEXEL, MOST_TEXEL = 1.5, 2.5, 5.0  # pixels of the window
TILT, FOV = -24.0, 55.0  # degrees, at first
QUICK, SLOW = 0.020, 0.034  # seconds of a picture: with quicker ones the land becomes finer, with slower ones coarser
_NOTCH = 0.22  # of the way to what the pointer is over, in powers of two, for a notch of the wheel
_GLIDE = 9.0  # parts of what is left to go, in a second
_CLEAR = 0.04  # of the distance to what is flown to: how high above the ground the eye stays at least
_FARTHEST = 64.0  # frames from the frame's middle


class KeptTile(NamedTuple):
    """A tile, the painting's revision that it shows, and when it came."""

    tile: LandTile
    revision: int
    came: float


@dataclass(slots=True)
class LandState:
    """`on`: the canvas shows land; `eye`: None until the height of the ground is known; `asked`: what was asked for it;
    `kept`: tiles, the longest unused first; `drawn`: those of the last picture, nearest first; `room`: left, top, width
    and height of the picture in the window; `changed`: it is to be drawn again; `moved`: when the eye last did;
    `still`: the picture at rest, `number`: of the one that is wanted; `triangles`, `took`: of the last picture;
    `taken`: when a tile last came; `stands`: where the eye is to be as soon as the ground below it is known."""

    on: bool = False
    eye: Eye | None = None
    asked: object = None
    frame: Rect = field(default_factory=lambda: Rect(0, 0, 1, 1))
    kept: OrderedDict[TileKey, KeptTile] = field(default_factory=OrderedDict)
    drawn: list[TileKey] = field(default_factory=list)
    lacking: int = 0
    room: tuple[int, int, int, int] = (0, 0, 1, 1)
    texel: float = FIRST_TEXEL
    changed: bool = True
    moved: float = 0.0
    still: StillCome | None = None
    number: int = 0
    triangles: int = 0
    took: float = 0.0
    goal: Hit | None = None
    left: float = 0.0  # of the way to the goal, powers of two
    held: int = 0  # bytes of tiles
    clear: float = 1.0
    taken: float = 0.0
    stands: Outlook | None = None

    @property
    def size(self) -> tuple[int, int]:
        """Gives width and height of the picture."""
        return self.room[2], self.room[3]

    def sight(self) -> LandSight:
        """Returns what is seen."""
        assert self.eye is not None
        return LandSight(self.eye, self.size, self.clear, self.texel, self.frame)

    def look(self, eye: Eye, now: float) -> None:
        """Looks from elsewhere; not from below the ground."""
        under = ground_under((kept.tile for kept in self.kept.values()), eye.x, eye.y)
        least = self._least()
        if under is not None:
            eye = replace(eye, z=max(eye.z, under + least))
            self.clear = max(eye.z - under, least)
        self.eye, self.moved, self.changed = eye, now, True
        self.still = None

    def stand(self, outlook: Outlook | None) -> None:
        """Goes to where a bookmark looks from; None: to before what the canvas shows, if the land is seen."""
        self.on, self.stands = self.on or outlook is not None, outlook
        self.eye = self.asked = self.still = self.goal = None
        self.left, self.changed = 0.0, True

    def outlook_here(self) -> Outlook | None:
        """Returns what a bookmark tells of where the eye is; None where the canvas is seen."""
        eye = self.eye
        if eye is None or not self.on:
            return None
        under = ground_under((kept.tile for kept in self.kept.values()), eye.x, eye.y)
        high = max(eye.z - under, 1e-12) if under is not None else self.clear
        level = max(0, math.ceil(-math.log2(high)) + 10)
        by = 1 << level
        return Outlook(level, round(eye.x * by), round(eye.y * by), high * by, eye.azimuth, eye.tilt, eye.fov)

    def _least(self) -> float:
        """Returns how near the ground the eye may come."""
        goal = 0.0 if self.goal is None else _CLEAR * self.goal.away
        return max(goal, math.ldexp(16.0, -FINEST), 0.02 * self.clear if self.goal is None else 0.0)

    def hit(self, x: float, y: float) -> Hit | None:
        """Returns what of the land is seen at a point of the window; None for the sky."""
        if self.eye is None:
            return None
        way = self.eye.direction(x - self.room[0], y - self.room[1], self.size)
        tiles = [self.kept[key].tile for key in self.drawn if key in self.kept]
        return met(tiles, self.eye, way)

    def level_at(self, away: float) -> int:
        """Returns the level whose pixels are nearest to the window's so far away."""
        assert self.eye is not None
        return min(FINEST, round(-math.log2(away * self.eye.pixel(self.size[0]))))

    def fly(self, x: float, y: float, notches: float) -> None:
        """Goes towards, or away from, what is under a point of the window."""
        found = self.hit(x, y)
        if found is None and self.eye is not None:  # the sky: as far as the land is away
            way = self.eye.direction(x - self.room[0], y - self.room[1], self.size) * self.clear * 4.0
            found = Hit(
                self.eye.x + as_fraction(way[0]),
                self.eye.y + as_fraction(way[1]),
                self.eye.z + float(way[2]),
                4 * self.clear,
            )
        if found is not None:
            same = self.goal is not None and self.left * notches > 0.0
            self.goal, self.left = found, (self.left if same else 0.0) + _NOTCH * notches

    def step(self, seconds: float, now: float) -> bool:
        """Flies on; True while it does."""
        if self.eye is None or self.goal is None:
            return False
        part = min(1.0, _GLIDE * seconds)
        by = self.left * part
        self.left -= by
        if abs(self.left) < 0.004:
            by, self.left = by + self.left, 0.0
        gone = as_fraction(1.0 - 2.0**-by)
        eye, goal = self.eye, self.goal
        x, y = place_kept(eye.x + (goal.x - eye.x) * gone), place_kept(eye.y + (goal.y - eye.y) * gone)
        z = eye.z + (goal.z - eye.z) * float(gone)
        far = _FARTHEST * max(self.frame.width, self.frame.height)
        if by > 0.0 or (abs(z) < far and max(abs(x), abs(y)) < far + max(map(abs, self.frame))):
            self.goal = goal._replace(away=goal.away * 2.0**-by)
            self.look(replace(eye, x=x, y=y, z=z), now)
        if not self.left:
            self.goal = None
        return bool(self.left)

    def orbit(self, about: Hit, across: float, up: float, now: float) -> None:
        """Turns around a place, by degrees."""
        assert self.eye is not None
        before = self.eye
        after = before.turned(across, max(-85.0 - before.tilt, min(40.0 - before.tilt, up)))
        off = np.array([float(before.x - about.x), float(before.y - about.y), before.z - about.z])
        seen = before.axes() @ off
        moved = after.axes().T @ seen
        self.look(
            replace(
                after,
                x=place_kept(about.x + as_fraction(moved[0])),
                y=place_kept(about.y + as_fraction(moved[1])),
                z=about.z + float(moved[2]),
            ),
            now,
        )

    def take(self, tile: LandTile, revision: int, now: float) -> None:
        """Keeps a tile, and lets go those that were not used for longest."""
        before = self.kept.pop(tile.key, None)
        self.held += tile.held - (before.tile.held if before is not None else 0)
        self.kept[tile.key] = KeptTile(tile, revision, now if before is None else before.came)
        self.changed, self.taken = True, now

    def use(self, wanted: set[TileKey]) -> list[TileKey]:
        """Notes which tiles are wanted now; returns those that are let go."""
        for key in wanted:
            if key in self.kept:
                self.kept.move_to_end(key)
        gone: list[TileKey] = []
        while self.held > MOST_HELD and len(self.kept) > len(wanted):
            key, old = self.kept.popitem(last=False)
            self.held -= old.tile.held
            gone.append(key)
        return gone

    def adapt(self, seconds: float) -> None:
        """Takes finer or coarser tiles from now on, as one picture took so long."""
        self.took = seconds
        if seconds > SLOW:
            self.texel = min(MOST_TEXEL, self.texel * 1.04)
        elif seconds < QUICK:
            self.texel = max(LEAST_TEXEL, self.texel * 0.985)

    def forget(self) -> None:
        """Another painting is to be seen, or none."""
        self.kept.clear()
        self.drawn, self.still, self.goal, self.left = [], None, None, 0.0
        self.held, self.changed = 0, True
        self.eye = self.asked = self.stands = None


def first_eye(x: Fraction, y: Fraction, z: float, wide: float, azimuth: float) -> Eye:
    """Returns an eye that sees a place of the ground in the middle, so `wide` a part of the land, pixels of level 0."""
    turn, down = math.radians(azimuth), math.radians(-TILT)
    away = 0.5 * wide / math.tan(math.radians(FOV) / 2)
    flat = away * math.cos(down)
    return Eye(
        place_kept(x - as_fraction(flat * math.sin(turn))),
        place_kept(y + as_fraction(flat * math.cos(turn))),
        z + away * math.sin(down),
        azimuth,
        TILT,
        FOV,
    )


def error_text(state: LandState) -> str:
    """Tells by how many pixels of the window the picture at rest is wrong, as a rule and at most; nothing where that is
    not known."""
    error = None if state.still is None else state.still.error
    if error is None:
        return ""
    usual, most = (max(one, 0.1) for one in error)
    return f"error about {usual:.1f} px, at most {most:.{0 if most >= 10 else 1}f}"
