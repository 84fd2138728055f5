"""Marching ants: the rim of what is selected, drawn on the card, thin at any zoom."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import moderngl
import numpy as np

from app.canvas.screen import Insets, free_part
from app.canvas.shader_files import shader_source
from app.canvas.view import View, dyadic_place
from engine.numeric.similarity import Dyadic, Similarity
from engine.studio.selecting.ants_records import Ants

WALK, SECOND = 8, 0.3  # places of the walk, and seconds from one to the next
_WIDE, _TURNS = 1.0, 8.0  # points: of the line, and of a light and a dark piece


class AntPlan(NamedTuple):
    """What is to be seen of the rim.  Plans that are equal look alike."""

    ants: int
    step: int
    by: Similarity | None = None  # where it is seen, if that is elsewhere


class AntLine:
    """All calls from the thread that owns the context."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._program: Any = ctx.program(shader_source("ants.vert"), shader_source("ants.frag"))
        self._most, self._held = 0, 0
        self._buffer: moderngl.Buffer | None = None
        self._lines: moderngl.VertexArray | None = None

    def plan(self, ants: Ants | None, now: float, by: Similarity | None = None) -> AntPlan | None:
        """Returns what to draw, seen through a similarity; None for nothing."""
        return None if ants is None or not len(ants.lines) else AntPlan(id(ants), int(now / SECOND) % WALK, by)

    def draw(self, plan: AntPlan, ants: Ants, view: View, insets: Insets, scale: float) -> None:
        """Draws the rim where panels leave room."""
        if plan.ants != self._held:
            self._held = plan.ants
            if len(ants.lines) > self._most:
                self._most = 2 * len(ants.lines)
                self._buffer = self._ctx.buffer(reserve=16 * self._most)
                self._lines = self._ctx.vertex_array(self._program, [(self._buffer, "4f/i", "line")])
            assert self._buffer is not None
            self._buffer.orphan()
            self._buffer.write(ants.lines.tobytes())
        program, (a, b, c, d), by = self._program, view.matrix(), view.scale(ants.level)
        program["origin"] = view.pixel_to_screen(ants.level, ants.area.x0, ants.area.y0)
        turn = np.array([[a, b], [c, d]]) * by
        if plan.by is not None:
            corner = plan.by(Dyadic.of(ants.area.x0, ants.area.y0, ants.level))
            program["origin"] = view.to_screen(dyadic_place(corner))
            turn = turn @ _matrix(plan.by)
        program["turn"] = tuple(turn.ravel().tolist())
        program["size"], program["wide"] = (view.width, view.height), max(1.0, _WIDE * scale)
        program["turns"], program["phase"] = _TURNS * scale, plan.step / WALK
        self._ctx.scissor = free_part(view, insets)
        self._ctx.disable(moderngl.BLEND)
        assert self._lines is not None
        self._lines.render(moderngl.TRIANGLE_STRIP, vertices=4, instances=len(ants.lines))
        self._ctx.scissor = None


def _matrix(by: Similarity) -> np.ndarray:
    """Returns what a similarity makes of steps to the right and down: float64 (2, 2)."""
    re, im = (math.ldexp(float(v), -by.c.e) for v in (by.c.x, by.c.y))
    return np.array([[re, im], [im, -re]]) if by.mirror else np.array([[re, -im], [im, re]])
