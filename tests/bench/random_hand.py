"""What an artist may do in the window, at random: a generator of seconds to rest before the next thing."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from app.actions.actions import ACTIONS, perform
from app.canvas.view import place_of_pixel
from app.desk import palette
from app.desk.desk import Desk
from app.input.events import LEFT, PenEvent
from engine.brush.modes import MODES
from engine.numeric.blend import BLENDS
from engine.painting import commands as c
from engine.studio.requests import Do, Export, Save

STRIPS = ("history", "places", "analysis", "lab", "match", "examples", "")
DEEPEST, FARTHEST = -3, 6  # levels that are painted on
LAYERS = 6  # at most
SPAN = 1600  # pixels of level 0, from 0, about which it is painted
BEHIND = 64  # requests that wait for the engine, about a stroke's: with more, the hand sees that, and waits, too
_LOOK = 0.05  # seconds from one look at it to the next

Rests = Iterator[float]


class RandomHand:
    """The pointer of a window, instead of a mouse, and what else is done there; `folder`: of what is saved; `waiting`
    counts the requests that wait for the engine; `waited`: seconds that the hand did, as they were many."""

    name = "hand"

    def __init__(self, desk: Desk, rng: np.random.Generator, folder: Path, waiting: Callable[[], int]) -> None:
        self._desk, self._rng, self._folder, self._waiting = desk, rng, folder, waiting
        self.waited = 0.0
        self._events: list[PenEvent] = []
        self.done: dict[str, int] = {}
        self._doings: tuple[tuple[float, Callable[[], Rests]], ...] = (
            (1.0, self._stroke),
            (0.25, self._brush),
            (0.12, self._setting),
            (0.15, self._travel),
            (0.08, self._act("in", "out", "one", "fit", "turn_left", "turn_right", "upright", "mirror")),
            (0.12, self._act("undo")),
            (0.06, self._act("redo")),
            (0.012, self._undo_many),
            (0.06, self._layer),
            (0.02, self._act("bookmark", "back", "forward", "nearest", "swap", "eraser", "brush")),
            (0.015, self._strip),
            (0.015, self._save),
            (0.004, self._export),
            (0.01, self._rest),
        )

    def events(self) -> list[PenEvent]:
        """Returns what the pen did since the last call."""
        events, self._events = self._events, []
        return events

    def close(self) -> None:
        """Has nothing to give back."""

    def work(self) -> Rests:
        """Does one thing after another, for ever."""
        weights = np.array([weight for weight, _ in self._doings])
        while True:
            while self._waiting() > BEHIND:
                self.waited += _LOOK
                yield _LOOK
            doing = self._doings[self._rng.choice(len(weights), p=weights / weights.sum())][1]
            name = doing.__name__.strip("_")
            self.done[name] = self.done.get(name, 0) + 1
            yield from doing()
            yield float(self._rng.exponential(0.05))

    def _stroke(self) -> Rests:
        left, top, right, bottom = self._desk.free_area()
        rng, count = self._rng, int(self._rng.integers(8, 90))
        middle = rng.uniform((left + 40, top + 40), (right - 40, bottom - 40))
        reach, phase, t = rng.uniform(5, 260, 2), rng.uniform(0, math.tau, 2), np.linspace(0, 1, count)
        x = np.clip(middle[0] + reach[0] * np.sin(math.tau * t + phase[0]), left + 2, right - 2)
        y = np.clip(middle[1] + reach[1] * np.sin(0.7 * math.tau * t + phase[1]), top + 2, bottom - 2)
        pressure = np.clip(0.2 + np.sin(math.pi * t) * rng.uniform(0.3, 1.0), 0.05, 1.0)
        self._pen("move", x[0], y[0], 0.0)
        yield 0.01
        self._pen("down", x[0], y[0], pressure[0])
        for at in zip(x, y, pressure, strict=True):
            yield 0.008
            self._pen("move", *at)
        self._pen("up", x[-1], y[-1], 0.0)
        yield 0.02

    def _pen(self, kind: str, x: float, y: float, pressure: float) -> None:
        button = LEFT if kind in ("down", "up") else 0
        self._events.append(
            PenEvent(kind, float(x), float(y), float(pressure), time=time.monotonic(), button=button, pen=True)
        )

    def _brush(self) -> Rests:
        presets = self._desk.known.presets
        if presets:
            palette.take(self._desk, presets[self._rng.integers(len(presets))])
            self._desk.hand.change(radius=round(min(self._desk.hand.brush.radius, 70.0), 2))
        yield 0.05

    def _setting(self) -> Rests:
        rng, hand = self._rng, self._desk.hand
        hand.colour = tuple(rng.random(3).tolist())
        hand.change(radius=round(float(np.exp(rng.uniform(0, 4.4))), 2), opacity=round(float(rng.uniform(0.2, 1)), 2))
        if hand.brush.example is None and rng.random() < 0.4:
            hand.change(mode=str(rng.choice([name for name, row in MODES.items() if not row.grows])))
        yield 0.05

    def _travel(self) -> Rests:
        desk, place = self._desk, place_of_pixel(0, *self._rng.integers(0, SPAN, 2).tolist())
        level = min(FARTHEST, max(DEEPEST, desk.view.level + int(self._rng.integers(-1, 2))))
        desk.look_at(place, float(level), seconds=0.4)
        yield 0.6

    def _act(self, *names: str) -> Callable[[], Rests]:
        def act() -> Rests:
            desk = self._desk
            perform(desk, ACTIONS[str(self._rng.choice(names))])
            yield 0.15
            if not DEEPEST - 1 <= desk.view.level <= FARTHEST:
                desk.fit()

        act.__name__ = names[0]
        return act

    def _undo_many(self) -> Rests:
        many = int(self._rng.integers(2, 30))
        self._desk.post(Do(c.Undo(many) if self._rng.random() < 0.5 else c.Redo(many)))
        yield 0.3

    def _layer(self) -> Rests:
        rng, desk, scene = self._rng, self._desk, self._desk.known.scene
        if scene is not None and scene.layers:
            name = scene.layers[rng.integers(len(scene.layers))].name
            what = rng.random()
            if what < 0.3 and len(scene.layers) < LAYERS:
                perform(desk, ACTIONS[str(rng.choice(("add_layer", "add_group", "duplicate")))])
            elif what < 0.4 and len(scene.layers) > 2:
                perform(desk, ACTIONS["remove"])
            elif what < 0.6:
                perform(desk, ACTIONS[str(rng.choice(("raise", "lower")))])
            elif what < 0.8:
                blend, opacity = str(rng.choice(list(BLENDS))), round(float(rng.uniform(0.3, 1.0)), 2)
                desk.post(Do(c.SetLayer(name, opacity=opacity, blend=blend)))
            else:
                desk.post(Do(c.SelectLayer(name)))
        yield 0.1

    def _strip(self) -> Rests:
        self._desk.strip = str(self._rng.choice(STRIPS))
        yield 0.5

    def _save(self) -> Rests:
        self._desk.post(Save(self._folder / "random.ora"))
        yield 0.2

    def _export(self) -> Rests:
        self._desk.post(Export(self._folder / "random.png", level=0))
        yield 0.2

    def _rest(self) -> Rests:
        yield float(self._rng.uniform(1.0, 6.0))
