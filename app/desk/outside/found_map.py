"""A height map that was read, and is to be laid as ground."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from app.canvas.view import Place

if TYPE_CHECKING:
    from engine.texture.image import ImageSource


@dataclass(frozen=True, slots=True)
class FoundMap:
    """A map that was read: the file as the painting will hold it, `told` in words, its pixels across and down, and how
    high its lowest and highest lie in pixels where nothing is said; `scaled`: the file tells that itself."""

    path: Path
    place: Place
    held: ImageSource
    told: str
    size: tuple[int, int]
    ends: tuple[float, float]
    scaled: bool
