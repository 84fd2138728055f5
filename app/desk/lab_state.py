"""The texture lab as the window knows it: what is set, with which brush its spectrum is painted, what came back."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from immutables import Map

from app.desk.holding import dipping
from engine.brush.ops import chosen
from engine.brush.parts import Component, Surface
from engine.brush.settings import Brush
from engine.studio.requests import Request
from engine.studio.textures.texture_requests import LabRest, LabSet, LabUse
from engine.studio.textures.texture_results import LabScene

SETTLE = 0.15  # seconds without change before strokes are shown with the texture
FIRST = Map({"shape": "noise", "b": 1.4})  # the shape of a lab just opened
SIZES = (128, 256, 512)
PICTURED = ("image", "canvas", "texture")  # shapes that are the spectrum of a picture
_FULL, _LIGHT = 0.8, 0.6  # opacity that hides nearly all of a paper, and one that shows it
PAINTED = ("painted", "own")  # phases that have a sheet
WHITE, BLACK = "#ffffff", "#000000"


@dataclass(slots=True)
class LabState:
    """`radius`: of its brush, in pixels of a spectrum 256 wide; `spot`: corner and side of the spectrum on the screen,
    framebuffer pixels, None while it is not to be seen."""

    made: LabSet = field(default_factory=lambda: LabSet(shapes=(FIRST,)))
    radius: float = 7.0
    strength: float = 0.8
    erasing: bool = False
    coloured: bool = False
    follow: bool = True  # a texture in use follows the lab
    painting: bool = False
    scene: LabScene | None = None
    spot: tuple[float, float, float] | None = None
    shown: tuple[int, int] = (112, 64)  # width and height of the pictures of strokes, framebuffer pixels
    _posted: LabSet | None = None
    _resting: tuple[Any, ...] = ()
    _since: float = 0.0

    def change(self, **changes: Any) -> None:
        """Sets members of what is made."""
        self.made = replace(self.made, **changes)

    def shape(self, index: int, name: str, value: Any) -> None:
        """Sets another number for one of the shapes."""
        shapes = list(self.made.shapes)
        shapes[index] = shapes[index].set(name, value)
        self.change(shapes=tuple(shapes))

    @property
    def pictured(self) -> bool:
        """Tells whether the spectrum begins with a picture's, which has phases too."""
        return any(shape["shape"] in PICTURED for shape in self.made.shapes)

    @property
    def endless(self) -> bool:
        """Tells whether the texture is a field of scattered copies."""
        return self.made.field.get("field") == "sparse"

    @property
    def window(self) -> int:
        """Width of the sample, and of the window over it, in pixels of the stroke's level."""
        return int(self.made.field.get("period", self.made.size[0]))

    def begin_with(self, shapes: tuple[Map[str, Any], ...]) -> None:
        """Sets other shapes; without a picture there are no phases of its own."""
        self.change(shapes=shapes)
        if self.made.phase == "own" and not self.pictured:
            self.phase("random")

    def phase(self, phase: str) -> None:
        """Sets other phases; those that are shown can be painted on."""
        self.change(phase=phase, sheet=self.made.sheet if phase in PAINTED else "amplitude")

    def turn(self, forward: bool) -> None:
        """Turns the transform the other way: of a pattern as it is, since random phases would leave only noise of
        it."""
        usual = ("random", "zero") if forward else ("zero", "random")
        self.change(forward=forward)
        if self.made.phase == usual[0]:
            self.phase(usual[1])

    def field(self, name: str, value: Any) -> None:
        """Sets another number of the texture; None for its default."""
        held = self.made.field
        without = held.delete(name) if name in held else held
        self.change(field=without if value is None else held.set(name, value))

    def over(self, x: float, y: float) -> bool:
        """Tells whether a point of the screen is on the spectrum."""
        if self.spot is None:
            return False
        left, top, side = self.spot
        return left <= x < left + side and top <= y < top + side

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Returns a point of the screen in pixels of the spectrum."""
        left, top, side = self.spot if self.spot is not None else (0.0, 0.0, 1.0)
        return (x - left) / side * self.made.size[0], (y - top) / side * self.made.size[1]

    def brush(self, brush: Brush, colour: str, eraser: bool, built_in: frozenset[str]) -> Brush:
        """Returns the artist's brush as it paints in the lab: its textures are those that every painting has
        (`built_in`).  It changes what is there if it can do so without colours and layers; otherwise it paints."""
        brush = only_with(brush, built_in)
        row = brush.row
        fits = row.in_lab and (not row.uses_op or _changes(brush))
        colours = self.coloured and self.made.sheet == "amplitude"
        return replace(
            brush,
            radius=self.radius * self.made.size[0] / 256,
            opacity=self.strength,
            colour=colour if colours else WHITE,
            mode="erase" if eraser or self.erasing else row.name if fits else "paint",
            ink=brush.ink if colours else tuple(replace(part, colour=BLACK) for part in brush.ink),
            op=brush.op if fits and row.uses_op else "toward",
            edge=None,
        )

    def ask(self, post: Callable[[Request], None], now: float, brush: Brush) -> None:
        """Posts what was set, at once, and a while after the last change, that the lab has come to rest."""
        if self.made != self._posted:
            self._posted = self.made
            post(self.made)
        scene = self.scene
        done = (scene.strokes, scene.can_undo, scene.can_redo) if scene is not None else ()
        state = self.made, brush, self.shown, done
        if state != self._resting or self.painting:
            self._resting, self._since = state, now
        if self._since and now - self._since >= SETTLE and not self.painting:
            self._since = 0.0
            post(LabRest(brush, self.shown))

    @property
    def waiting(self) -> bool:
        """Tells whether the lab is about to come to rest."""
        return self._since > 0

    def use(self, post: Callable[[Request], None], name: str) -> None:
        """Makes the texture one of the painting; it follows the lab if it is to."""
        post(LabUse(name))
        if not self.follow:
            post(LabUse(""))


def _changes(brush: Brush) -> bool:
    """Tells whether its op needs neither a colour nor a layer nor a texture that the brush has not."""
    op = chosen(brush.op)
    if op.row is None:
        return True
    return not (op.row.coloured or "layer" in op.parameters or (op.by_texture and not brush.ink))


def only_with(brush: Brush, textures: frozenset[str]) -> Brush:
    """Returns the brush without the parts that need other textures."""
    parts: dict[str, Any] = {}
    for name in ("density", "grain", "tip"):
        held = getattr(brush, name)
        parts[name] = held if held is not None and held.texture in textures else None
    return replace(brush, ink=tuple(part for part in brush.ink if part.texture in textures), **parts)


def with_texture(brush: Brush, how: str, texture: str, pen: bool = False) -> Brush:
    """Returns the brush with a texture in its ink, as its dry brush or as its paper."""
    if how == "ink":
        return replace(brush, ink=(dipping.fix(Component(texture, 1.0, WHITE)),), mode="paint")
    surface: dict[str, Any] = {how: Surface(texture, 0.9)}
    return lightened(replace(brush, **surface), pen) if how == "grain" else replace(brush, **surface)


def lightened(brush: Brush, pen: bool) -> Brush:
    """Returns the brush as it shows a paper that it got just now: full coverage fills every hollow of the grain, so
    one that covers fully covers less, unless a pen's pressure sees to that, or an edge that leaves the inside
    lighter."""
    felt = (pen and "opacity" in brush.dynamics) or brush.edge is not None
    return brush if felt or brush.opacity <= _FULL else replace(brush, opacity=_LIGHT)
