"""The region of an example as it is painted: in and out with a round brush, by transparency, by colour, with undo."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from engine.numeric.address import Rect

STEPS = 100  # that can be taken back
DIM, TINT = 0.22, (28, 32, 40)  # how much of what is outside still shows, and over what; sRGB
CHECKER, LIGHT, DARK = 8, 226, 198  # the paper under a picture with holes: side of its squares, pixels; greys
SMOOTH = 2  # pixels that one smoothing reaches, each of PASSES times
PASSES = 3
RADII = (0.5, 300.0)
WAYS = ("in", "out", "colour")


@dataclass(slots=True)
class History:
    """Regions before the present one, and those that were taken back, a bit a pixel."""

    before: list[bytes] = field(default_factory=list)
    after: list[bytes] = field(default_factory=list)

    @property
    def can_undo(self) -> bool:
        return bool(self.before)

    @property
    def can_redo(self) -> bool:
        return bool(self.after)

    def keep(self, inside: np.ndarray) -> None:
        """A region that is about to change."""
        self.before.append(_packed(inside))
        del self.before[:-STEPS]
        self.after.clear()

    def step(self, inside: np.ndarray, by: int) -> np.ndarray:
        """The region before this one (-1) or after it (1); the same one if there is none."""
        taken, given = (self.before, self.after) if by < 0 else (self.after, self.before)
        if not taken:
            return inside
        given.append(_packed(inside))
        return _unpacked(taken.pop(), inside.shape)

    def last(self, inside: np.ndarray) -> np.ndarray:
        """The region before this one, which stays where it is."""
        return _unpacked(self.before[-1], inside.shape) if self.before else inside


@dataclass(slots=True, eq=False)
class Mask:
    """`pixels`: the picture, uint8 RGBA (h, w, 4), not premultiplied; `inside`: its region, bool (h, w).

    `radius`: of the brush, in pixels of the picture; `way`: what a stroke does, of WAYS; `tolerance`: how far a colour
    may be from the one that is clicked, 0..1; `joined`: only what hangs together with it; `dirty`: what has changed
    since it was last shown.
    """

    pixels: np.ndarray
    inside: np.ndarray
    radius: float = 12.0
    way: str = "in"
    tolerance: float = 0.1
    joined: bool = True
    version: int = 0
    saved: int = 0
    dirty: Rect | None = None
    history: History = field(default_factory=History)
    _at: tuple[float, float] | None = None
    _clicked: tuple[int, int, int] | None = None  # where a colour was picked last, and the version that made

    def __post_init__(self) -> None:
        self.dirty = self.whole

    @property
    def whole(self) -> Rect:
        return Rect(0, 0, self.inside.shape[1], self.inside.shape[0])

    @property
    def modified(self) -> bool:
        return self.version != self.saved

    @property
    def opaque(self) -> bool:
        """Whether the picture has no holes."""
        return bool(self.pixels[..., 3].min() > 0)

    # --- strokes -----------------------------------------------------------------------------------------------------

    def begin(self, x: float, y: float) -> None:
        """The pen touches the picture at a point in its pixels."""
        if self.way == "colour":
            self.pick(int(x // 1), int(y // 1))
            return
        self._remember()
        self._at = None
        self.to(x, y)

    def to(self, x: float, y: float) -> None:
        """The pen has moved there."""
        if self.way == "colour":
            return
        start, self._at = self._at or (x, y), (x, y)
        reach = self.radius + 1.0
        xs, ys = (start[0], x), (start[1], y)
        box = Rect(
            int(min(xs) - reach), int(min(ys) - reach), int(max(xs) + reach) + 1, int(max(ys) + reach) + 1
        ).intersect(self.whole)
        if box.empty:
            return
        taken = _near(box, start, (x, y)) <= self.radius**2
        self.inside[box.slices(self.whole)][taken] = self.way == "in"
        self._changed(box)

    def abandon(self) -> None:
        """The stroke in progress is dropped."""
        if self.way != "colour":
            self.step(-1)
            self.history.after.clear()

    def pick(self, x: int, y: int) -> None:
        """Everything of the colour at a pixel leaves the region."""
        if not (0 <= x < self.whole.width and 0 <= y < self.whole.height):
            return
        self._remember()
        self._apply(x, y)

    def tolerate(self, tolerance: float, joined: bool) -> None:
        """Another tolerance; the colour that was picked just now is picked again with it."""
        if (tolerance, joined) == (self.tolerance, self.joined):
            return
        self.tolerance, self.joined = tolerance, joined
        if self._clicked is not None and self._clicked[2] == self.version:
            x, y, _ = self._clicked
            self.inside = self.history.last(self.inside)
            self._apply(x, y)

    def _apply(self, x: int, y: int) -> None:
        self.inside &= ~alike(self.pixels, x, y, self.tolerance, self.joined)
        self._changed(self.whole)
        self._clicked = x, y, self.version

    def resize(self, factor: float) -> None:
        """Another size of the brush."""
        self.radius = round(max(RADII[0], min(RADII[1], self.radius * factor)), 1)

    # --- all at once, and steps --------------------------------------------------------------------------------------

    def put(self, inside: np.ndarray) -> None:
        """Another region in place of this one."""
        self._remember()
        self.inside = inside
        self._changed(self.whole)

    def step(self, by: int) -> None:
        """Takes the last step back (-1), or does it again (1)."""
        inside = self.history.step(self.inside, by)
        if inside is not self.inside:
            self.inside = inside
            self._changed(self.whole)

    def _remember(self) -> None:
        self.history.keep(self.inside)

    def _changed(self, box: Rect) -> None:
        self.version += 1
        self.dirty = box if self.dirty is None else self.dirty.union(box)


def shown(mask: Mask, box: Rect) -> np.ndarray:
    """A part of the picture over paper, what is outside dimmed and the region’s edge marked: uint8 (h, w, 3)."""
    around = box.grown(1).intersect(mask.whole)
    inside = mask.inside[around.slices(mask.whole)]
    flat = over_paper(mask.pixels[around.slices(mask.whole)], around.x0, around.y0).astype(np.float32)
    dimmed = np.array(TINT, np.float32) + DIM * (flat - np.array(TINT, np.float32))
    out = np.where(inside[..., None], flat, dimmed)
    edge = _edge(inside)
    out[edge] = 0.25 * out[edge] + 0.75 * 255
    return out[box.slices(around)].round().astype(np.uint8)


def over_paper(pixels: np.ndarray, x: int = 0, y: int = 0) -> np.ndarray:
    """RGBA (h, w, 4), not premultiplied, over a checker whose pixel (x, y) is the first: uint8 (h, w, 3)."""
    height, width = pixels.shape[:2]
    rows, columns = (np.arange(height) + y) // CHECKER, (np.arange(width) + x) // CHECKER
    paper = np.where((rows[:, None] + columns) % 2, DARK, LIGHT)[..., None].astype(np.uint32)
    alpha = pixels[..., 3:].astype(np.uint32)
    mixed = (pixels[..., :3] * alpha + paper * (255 - alpha) + 127) // 255
    found: np.ndarray = mixed.astype(np.uint8)
    return found


def alike(pixels: np.ndarray, x: int, y: int, tolerance: float, joined: bool) -> np.ndarray:
    """Where RGBA pixels, uint8 (h, w, 4), are like the one at (x, y), in every channel by at most `tolerance` (0..1);
    `joined`: only those that hang together with it.  Bool (h, w)."""
    colours = pixels.astype(np.int32)
    alpha = colours[..., 3:]
    seen = np.concatenate([colours[..., :3] * alpha // 255, alpha], axis=2)
    near: np.ndarray = np.abs(seen - seen[y, x]).max(axis=2) <= round(255 * tolerance)
    if not joined:
        return near
    from scipy import ndimage  # here: it takes its time to load

    parts, _ = ndimage.label(near)
    found: np.ndarray = parts == parts[y, x]
    return found


def smoothed(inside: np.ndarray) -> np.ndarray:
    """Where most of the surroundings are inside: bool (h, w).  The picture goes on past its edges as it ends there."""
    soft = inside.astype(np.float64)
    for _ in range(PASSES):
        for axis in (0, 1):
            soft = _averaged(soft, axis)
    found: np.ndarray = soft > 0.5
    return found


def _averaged(soft: np.ndarray, axis: int) -> np.ndarray:
    """The mean of 2 SMOOTH + 1 values along an axis."""
    ends = [(0, 0), (0, 0)]
    ends[axis] = (SMOOTH + 1, SMOOTH)
    total = np.pad(soft, ends, mode="edge").cumsum(axis=axis)
    count, size = 2 * SMOOTH + 1, soft.shape[axis]
    upper, lower = np.arange(count, count + size), np.arange(size)
    return (total.take(upper, axis) - total.take(lower, axis)) / count


def _near(box: Rect, start: tuple[float, float], end: tuple[float, float]) -> np.ndarray:
    """Squared distances of the middles of a box's pixels from a line: float64 (h, w)."""
    x = np.arange(box.x0, box.x1) + 0.5 - start[0]
    y = (np.arange(box.y0, box.y1) + 0.5 - start[1])[:, None]
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = dx * dx + dy * dy
    part = np.clip((x * dx + y * dy) / length, 0.0, 1.0) if length else np.zeros((box.height, box.width))
    found: np.ndarray = (x - part * dx) ** 2 + (y - part * dy) ** 2
    return found


def _edge(inside: np.ndarray) -> np.ndarray:
    """Pixels outside that touch the region."""
    grown = inside.copy()
    grown[1:] |= inside[:-1]
    grown[:-1] |= inside[1:]
    grown[:, 1:] |= inside[:, :-1]
    grown[:, :-1] |= inside[:, 1:]
    return grown & ~inside


def _packed(inside: np.ndarray) -> bytes:
    return np.packbits(inside).tobytes()


def _unpacked(bits: bytes, shape: tuple[int, ...]) -> np.ndarray:
    count = int(np.prod(shape))
    return np.unpackbits(np.frombuffer(bits, np.uint8), count=count).reshape(shape).astype(bool)
