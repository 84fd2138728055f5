"""Pictures as imgui shows them: each a texture on the card, under a name."""

from __future__ import annotations

from collections import deque
from typing import Any

import moderngl
import numpy as np
from imgui_bundle import imgui

from engine.numeric.address import Rect

_PAPER = 244  # grey of the paper under pictures with holes
_MANY, _MOST = "step ", 256  # what names begin with of which there is no end, and how many of those hang, the newest


class Gallery:
    """`shown`: by name, the references that imgui takes.  All calls from the thread that owns the context."""

    def __init__(self, ctx: moderngl.Context, shown: dict[str, Any]) -> None:
        self._ctx, self._shown = ctx, shown
        self._textures: dict[str, moderngl.Texture] = {}
        self._fresh: set[int] = set()
        self._many: deque[str] = deque()  # names of those, the first that was hung first

    def hang(self, name: str, pixels: np.ndarray) -> None:
        """Hangs a picture, uint8 (h, w, 4) premultiplied, over paper."""
        alpha = pixels[..., 3:].astype(np.uint16)
        flat = (pixels[..., :3] + (255 - alpha) * _PAPER // 255).clip(0, 255).astype(np.uint8)
        self._of(name, pixels.shape[1], pixels.shape[0]).write(np.ascontiguousarray(flat), alignment=1)

    def touch(self, name: str, size: tuple[int, int], box: Rect, pixels: np.ndarray) -> None:
        """Hangs a part, uint8 (h, w, 3), of a picture of `size` (width, height)."""
        viewport = (box.x0, box.y0, box.width, box.height)
        self._of(name, *size).write(np.ascontiguousarray(pixels), viewport=viewport, alignment=1)

    def veil(self, name: str, size: tuple[int, int], box: Rect, alpha: np.ndarray) -> None:
        """Hangs a part, uint8 (h, w), of a veil of `size` (width, height): white, as dense as the numbers say."""
        viewport = (box.x0, box.y0, box.width, box.height)
        shown = self._of(name, *size, parts=1)
        shown.swizzle = "111R"
        shown.write(np.ascontiguousarray(alpha), viewport=viewport, alignment=1)

    def drawn(self, name: str, size: tuple[int, int]) -> moderngl.Texture:
        """Returns what the card draws a picture of `size` (width, height) to."""
        return self._of(name, *size)

    def fresh(self) -> set[int]:
        """Returns the textures that have changed since the last call."""
        fresh, self._fresh = self._fresh, set()
        return fresh

    def _of(self, name: str, width: int, height: int, parts: int = 3) -> moderngl.Texture:
        """Returns the texture that a picture is written to."""
        old = self._textures.get(name)
        if old is None or old.size != (width, height):
            if old is not None:
                old.release()
            old = self._textures[name] = self._ctx.texture((width, height), parts, alignment=1)
            self._shown[name] = imgui.ImTextureRef(old.glo)
            self._take_down(name)
        self._fresh.add(old.glo)
        return old

    def _take_down(self, name: str) -> None:
        """Takes down what hangs for longest where a picture is one too many: it is sent again when it is wanted."""
        if not name.startswith(_MANY):
            return
        self._many.append(name)
        if len(self._many) > _MOST:
            first = self._many.popleft()
            if first not in self._many:  # it changed its size, and hangs again
                self._textures.pop(first).release()
                del self._shown[first]
