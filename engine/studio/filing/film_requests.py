"""What the window asks of films, as `engine.studio.requests`; as light as that."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from engine.painting.places import Bookmark


@dataclass(frozen=True, slots=True)
class FilmWish:
    """A film of the painting, in pictures of `size` (width, height), `fps` a second.

    `places`: views that it flies through, or the one that it shows; none: the frame; `replay`: the painting is made
    again, by `clock` ("strokes" or "pen"), with what was `undone` and the `brush` or without; `seconds`: None for as
    long as it takes.
    """

    size: tuple[int, int]
    places: tuple[Bookmark, ...] = ()
    fps: float = 30.0
    seconds: float | None = None
    replay: bool = True
    clock: str = "strokes"
    undone: bool = False
    brush: bool = False


@dataclass(frozen=True, slots=True)
class MakeFilm:
    """The film, as a file; one at a time."""

    path: Path
    wish: FilmWish


@dataclass(frozen=True, slots=True)
class PreviewFilm:
    """A small picture of where the film looks after a part of it, 0..1, and how long it is."""

    wish: FilmWish
    part: float


@dataclass(frozen=True, slots=True)
class StopFilm:
    """The film that is being made is given up."""


@dataclass(frozen=True, slots=True)
class FilmGrew:
    """So much of the film is made, 0..1; posted by the thread that makes it."""

    part: float


FilmRequest = MakeFilm | PreviewFilm | StopFilm | FilmGrew
