"""Films of the painting on the easel: one is made at a time, beside all else, and can be given up."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np

from engine.checks.owned import Owned
from engine.files.fault import Cancelled
from engine.film.aim import aim_at, aim_of
from engine.film.formats import writable, write_film
from engine.film.replaying import Making
from engine.film.sheets import Sheets, plan
from engine.film.shooting import Film, Shooting, frame_of
from engine.painting.recording import Recording
from engine.painting.value import Painting, Refusal
from engine.session.apply import STEPS
from engine.session.replay import opened
from engine.studio import faults, results
from engine.studio.easel import Easel
from engine.studio.filing.film_requests import FilmGrew, FilmWish, MakeFilm, PreviewFilm, StopFilm
from engine.studio.filing.writers import TELL, Post, Writers

PREVIEW = "film"  # the name of its picture
_SIDE = 400  # pixels of that, at most
UNKNOWN = "It is not known how this painting was made; a flight needs no more than the painting"
BUSY = "One film is made at a time; the other can be stopped"
Known = Callable[[], Recording | None]  # gives how the painting was made, if that is known


class Filming(Owned):
    """The film that is being made, if one is.  It belongs to the engine's thread."""

    def __init__(self, easel: Easel, writers: Writers, post: Post, known: Known) -> None:
        self._easel, self._writers, self._post, self._known = easel, writers, post, known
        self._given_up: threading.Event | None = None  # of the film that is being made
        self.handlers: dict[type, Callable[[Any], None]] = {
            MakeFilm: self._make,
            PreviewFilm: self._preview,
            StopFilm: lambda r: self.close(),
            FilmGrew: lambda r: self._easel.send(results.Filming(r.part)),
        }

    def close(self) -> None:
        """Gives the film up: no file is written."""
        if self._given_up is not None:
            self._given_up.set()

    def _make(self, request: MakeFilm) -> None:
        if self._given_up is not None:
            raise Refusal(BUSY)
        film = self._film(request.wish)
        given_up, tell = threading.Event(), _telling(self._post)
        self._given_up = given_up

        def write(painting: Painting) -> results.Result:
            cores = max(1, (os.cpu_count() or 1) - 1)  # one is left to who paints
            try:
                shooting, note = writable(request.path, Shooting(film, painting))
                write_film(request.path, shooting, tell, given_up.is_set, cores)
            except Cancelled:
                return results.Note("The film was stopped; no file is written", about="film")
            except Exception as error:
                return faults.told(error, "while a film was made", "film", request.path)
            told = f"Wrote {request.path.name}"
            return results.Note(f"{told}; {note}" if note else told, about="film")

        self._easel.send(results.Filming(0.0))
        self._writers.start(write, self._easel.session.painting, self._ended)

    def _ended(self, told: results.Result | None) -> None:
        self._given_up = None
        if told is not None:
            self._easel.send(told)
        self._easel.send(results.Filming())

    def _film(self, wish: FilmWish) -> Film:
        """Returns a film as the studio makes it.  Refusal if it is to be made again and nobody knows how."""
        recording = self._known() if wish.replay else None
        if wish.replay and recording is None:
            raise Refusal(UNKNOWN)
        frame = self._easel.session.painting.frame
        places = tuple(aim_of(place, wish.size) for place in wish.places) or (aim_at(0, frame, wish.size),)
        making = None if recording is None else making_of(recording)
        told = [place.outlook for place in wish.places] if making is None else [None]
        outlooks = tuple(one for one in told if one is not None) if None not in told else ()
        return Film(places, wish.size, wish.fps, wish.seconds, making, wish.clock, wish.undone, wish.brush, outlooks)

    def _preview(self, request: PreviewFilm) -> None:
        wish = request.wish
        scale = min(1.0, _SIDE / max(wish.size))
        size = max(1, round(wish.size[0] * scale)), max(1, round(wish.size[1] * scale))
        painting = self._easel.session.painting
        aim = Shooting(self._film(replace(wish, size=size, replay=False)), painting).at(request.part)
        with ThreadPoolExecutor(1) as pool:
            pixels = np.full((size[1], size[0], 4), 255, np.uint8)
            pixels[..., :3] = frame_of(Sheets(plan([aim], size), pool).parts(0, painting), size, pool)
        self._easel.send(results.Picture(PREVIEW, results.frozen(pixels)))
        self._easel.send(self._length(wish))

    def _length(self, wish: FilmWish) -> results.FilmLength:
        try:
            shooting = Shooting(self._film(wish))
        except Refusal as reason:
            return results.FilmLength(fault=str(reason))
        return results.FilmLength(shooting.seconds, shooting.count)


def making_of(recording: Recording) -> Making:
    """Returns what a film needs of a recording, to make its painting again."""
    return Making(recording, STEPS, lambda cache: opened(recording, cache, history_bytes=0))


def _telling(post: Post) -> Callable[[float], None]:
    """Returns what posts how much is done, not more often than is worth it."""
    told = 0.0

    def tell(part: float) -> None:
        nonlocal told
        now = time.monotonic()
        if now - told >= TELL:
            told = now
            post(FilmGrew(part))

    return tell
