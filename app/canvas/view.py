"""Where the artist looks: pan, zoom, rotate, mirror; screen to canvas and back, exact at any depth.

Level L has 2^L pixels per level-0 pixel.  Screen positions are framebuffer pixels, y down.  A place on the canvas is a
dyadic number with Python integers, so nothing is ever lost at level 60 or 1000: only differences to the view's centre,
which are small, become floats.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from engine.numeric.address import Rect
from engine.numeric.similarity import Dyadic

SUBPIXEL = 16  # bits: places are kept to 2^-16 of a pixel of the deepest level visited
FAR = 1 << 40  # pixels: anything farther from the centre is clamped before it becomes a float
_NAMES = ("million", "billion", "trillion", "quadrillion", "quintillion", "sextillion", "septillion", "octillion")


def _shifted(value: int, bits: int) -> int:
    """value * 2^bits, rounded down."""
    return value << bits if bits >= 0 else value >> -bits


@dataclass(frozen=True, slots=True)
class Place:
    """A point of the canvas: (x, y) * 2^-exponent, in level-0 pixels."""

    x: int
    y: int
    exponent: int

    def refined(self, exponent: int) -> Place:
        """Returns the same point with at least `exponent` fractional bits."""
        n = exponent - self.exponent
        return self if n <= 0 else Place(self.x << n, self.y << n, exponent)

    def moved(self, dx: float, dy: float, level: int) -> Place:
        """Moved by (dx, dy) pixels of `level`, rounded to 2^-16 of such a pixel; moving back restores the place."""
        fine = self.refined(level + SUBPIXEL)
        n = fine.exponent - level - SUBPIXEL
        x, y = round(dx * (1 << SUBPIXEL)), round(dy * (1 << SUBPIXEL))
        return Place(fine.x + (x << n), fine.y + (y << n), fine.exponent)

    def pixel(self, level: int) -> tuple[int, int]:
        """Returns the pixel of `level` that holds this point."""
        n = level - self.exponent
        return _shifted(self.x, n), _shifted(self.y, n)

    def offset(self, level: int, x: int, y: int) -> tuple[float, float]:
        """This point seen from the corner of pixel (x, y) of `level`, in pixels of that level."""
        n = level + SUBPIXEL - self.exponent
        return _small(_shifted(self.x, n) - (x << SUBPIXEL)), _small(_shifted(self.y, n) - (y << SUBPIXEL))


def _small(units: int) -> float:
    """2^-16 pixels as a float of pixels, clamped to +-2^40 pixels."""
    limit = FAR << SUBPIXEL
    return max(-limit, min(limit, units)) / (1 << SUBPIXEL)


def place_of_pixel(level: int, x: int, y: int) -> Place:
    """Returns the top-left corner of a pixel."""
    if level < 0:
        return Place(x << -level, y << -level, 0)
    return Place(x, y, level)


def dyadic_place(place: Dyadic) -> Place:
    """Returns the same place as a view tells it."""
    return Place(place.x, place.y, place.e) if place.e >= 0 else Place(place.x << -place.e, place.y << -place.e, 0)


@dataclass(frozen=True, slots=True)
class View:
    """Centre and zoom of the picture on a screen of width x height pixels.

    The zoom is 2^(level + fraction) screen pixels per level-0 pixel, 0 <= fraction < 1.  `angle` in radians turns the
    picture clockwise; `mirrored` swaps its left and right.
    """

    centre: Place
    level: int
    fraction: float
    width: int
    height: int
    angle: float = 0.0
    mirrored: bool = False

    @property
    def shown_level(self) -> int:
        """Returns the level whose pixels are nearest to screen pixels: 0.71 to 1.41 of them."""
        return self.level + (1 if self.fraction >= 0.5 else 0)

    def scale(self, level: int) -> float:
        """Screen pixels per pixel of `level`."""
        return math.ldexp(2.0**self.fraction, max(-1000, min(1000, self.level - level)))

    def matrix(self) -> tuple[float, float, float, float]:
        """(a, b, c, d): canvas vector (x, y) shows along (a x + b y, c x + d y), unit scale."""
        cos, sin = math.cos(self.angle), math.sin(self.angle)
        flip = -1.0 if self.mirrored else 1.0
        return flip * cos, -sin, flip * sin, cos

    def _canvas_vector(self, dx: float, dy: float) -> tuple[float, float]:
        """Returns a screen vector in pixels of the view's level."""
        a, b, c, d = self.matrix()  # orthogonal: the inverse is the transpose
        s = 2.0**-self.fraction
        return (a * dx + c * dy) * s, (b * dx + d * dy) * s

    def to_canvas(self, x: float, y: float) -> Place:
        """Returns the place under a screen point."""
        dx, dy = self._canvas_vector(x - self.width / 2, y - self.height / 2)
        return self.centre.moved(dx, dy, self.level)

    def to_screen(self, place: Place) -> tuple[float, float]:
        """Tells where a place shows; clamped when it is very far away."""
        level = self.shown_level
        x, y = self.centre.pixel(level)
        cx, cy = self.centre.offset(level, x, y)
        px, py = place.offset(level, x, y)
        return self._screen_point(px - cx, py - cy, level)

    def pixel_to_screen(self, level: int, x: int, y: int) -> tuple[float, float]:
        """Tells where the top-left corner of a pixel shows: exact integer difference first, then a small float."""
        cx, cy = self.centre.offset(level, x, y)
        return self._screen_point(-cx, -cy, level)

    def _screen_point(self, dx: float, dy: float, level: int) -> tuple[float, float]:
        a, b, c, d = self.matrix()
        s = self.scale(level)
        return self.width / 2 + (a * dx + b * dy) * s, self.height / 2 + (c * dx + d * dy) * s

    def visible(self, level: int) -> Rect:
        """Returns the pixels of `level` that the screen meets."""
        a, b, c, d = self.matrix()
        s = self.scale(level)
        w = (abs(a) * self.width + abs(c) * self.height) / (2 * s)
        h = (abs(b) * self.width + abs(d) * self.height) / (2 * s)
        x, y = self.centre.pixel(level)
        fx, fy = self.centre.offset(level, x, y)
        return Rect(
            x + math.floor(fx - w), y + math.floor(fy - h), x + math.ceil(fx + w), y + math.ceil(fy + h)
        )  # fmt: skip

    def zoomed(self, levels: float) -> View:
        """Zoomed about the middle of the screen; the centre stays exactly the same."""
        whole = math.floor(self.fraction + levels)
        return replace(self, level=self.level + whole, fraction=self.fraction + levels - whole)

    def held(self, place: Place, x: float, y: float) -> View:
        """This zoom, with `place` under the screen point (x, y).

        A function of the zoom and the place alone: zooming 60 levels out and in about one place ends where it began.
        """
        dx, dy = self._canvas_vector(self.width / 2 - x, self.height / 2 - y)
        return replace(self, centre=place.moved(dx, dy, self.level))

    def turned(self, angle: float, x: float, y: float) -> View:
        """Turned to `angle` about the screen point (x, y)."""
        return replace(self, angle=math.remainder(angle, math.tau)).held(self.to_canvas(x, y), x, y)

    def flipped(self) -> View:
        """Left and right of the picture swapped, about the middle of the screen."""
        return replace(self, mirrored=not self.mirrored, angle=-self.angle)

    def resized(self, width: int, height: int) -> View:
        """Gives the same view on a screen of another size, framebuffer pixels."""
        return replace(self, width=width, height=height)


def view_of(frame: Rect, area: tuple[float, float, float, float], width: int, height: int) -> View:
    """Returns the level-0 rectangle `frame` shown upright in the screen rectangle `area` (x0, y0, x1, y1), with a
    margin."""
    x0, y0, x1, y1 = area
    w, h = max(1, frame.width), max(1, frame.height)
    zoom = math.log2(min(max(x1 - x0, 16.0) / w, max(y1 - y0, 16.0) / h) * 0.94)
    if zoom > -0.1 and zoom < 0.5:
        zoom = 0.0  # so near to one to one that whole pixels are nicer
    level = math.floor(zoom)
    middle = Place(frame.x0 + frame.x1, frame.y0 + frame.y1, 1)
    return View(middle, level, zoom - level, width, height).held(middle, (x0 + x1) / 2, (y0 + y1) / 2)


def distance(view: View, level: int, fraction: float) -> float:
    """Levels of zoom from the view to (level, fraction)."""
    return (level - view.level) + (fraction - view.fraction)


def zoom_text(level: int, fraction: float) -> str:
    """Returns the magnification as people read it: `x 1,048,576`, `x 1.15 quintillion`, `1:4`, `1:1`."""
    sign = "x " if level + fraction >= 0 else "1:"
    zoom = abs(level + fraction)
    if zoom < 1e-9:
        return "1:1"
    if zoom >= 89:
        return f"{sign}10^{round(zoom * math.log10(2))}"
    ratio = 2.0**zoom
    if ratio < 10:
        return sign + f"{ratio:.2f}".rstrip("0").rstrip(".")
    if ratio < 1e8:
        return f"{sign}{ratio:,.0f}"
    group = min(len(_NAMES), int(math.log10(ratio)) // 3 - 1)
    return f"{sign}{ratio / 1000.0 ** (group + 1):.3g} {_NAMES[group - 1]}"
