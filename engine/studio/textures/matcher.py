"""Textures being matched while the artist paints: a preview that grows step by step, and textures made for use.

All work is done in small steps when nothing more urgent waits.  Newer settings take the place of older ones; a texture
that is to be used is made to the end, and defined when no stroke is in progress.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from engine.brush.checks import thawed
from engine.canvas.layers import Group
from engine.checks.field_error import FieldError
from engine.checks.owned import Owned
from engine.files.fault import FileError
from engine.files.strict_json import Fields
from engine.makers import heeger_bergen, with_structure
from engine.makers.heeger_bergen import Plan
from engine.numeric.colour_axes import ColourAxes
from engine.painting import commands as c
from engine.painting.capture import PictureSource
from engine.studio import faults, results
from engine.studio.easel import Easel
from engine.studio.textures import structure_ready
from engine.studio.textures import texture_requests as tq
from engine.studio.textures import texture_results as tr
from engine.studio.textures.taken_beside import taken_beside
from engine.texture.image import ImageSource
from engine.texture.matching import Pattern
from engine.texture.mixing import SplitColours
from engine.texture.structure.copied import counted_copies

_KEPT = 8  # pictures read
_SOON = 0.15  # of the work: a first look


@dataclass(eq=False, slots=True)
class _Work:
    """A texture on its way; `name`: under which it is to be defined, "" for a preview."""

    maker: str
    arguments: Any
    name: str = ""
    plan: Plan | None = None
    steps: Iterator[heeger_bergen.Made] | None = None
    done: float = 0.0
    colours: np.ndarray | None = None
    finished: bool = False
    counting: Iterator[float | None] | None = None
    copied: float = -1.0

    @property
    def structured(self) -> bool:
        """Tells whether it is made with a structure."""
        return self.plan is not None and self.plan.structure != with_structure.NO_STRUCTURE


class Matcher(Owned):
    """The textures being matched.  It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._pictures = _Pictures(easel)
        self._preview: _Work | None = None
        self._wanted: list[_Work] = []
        self._shown: tuple[str, ...] = ()  # shas of the examples whose pictures were sent
        self.handlers: dict[type, Callable[[Any], None]] = {
            tq.MatchSet: self._set,
            tq.MatchUse: self._use,
        }

    @property
    def pending(self) -> bool:
        """Tells whether a texture is left to match, and may be now."""
        if self._wanted:
            return not self._wanted[0].finished or self._easel.live is None
        return self._preview is not None and not self._preview.finished

    def step(self) -> None:
        """Does the next piece of work."""
        work = self._wanted[0] if self._wanted else self._preview
        assert work is not None
        try:
            if work.finished:
                self._wanted.pop(0)
                self._define(work)
            else:
                self._advance(work)
        except (FieldError, FileError) as error:
            self._drop(work)
            self._easel.send(tr.MatchScene(fault=str(error)))
        except Exception as error:
            self._drop(work)  # it would fail again
            self._easel.send(tr.MatchScene(fault=faults.words(error)))
            raise

    def _set(self, request: tq.MatchSet) -> None:
        if request.arguments is None:
            self._preview, self._shown = None, ()
            self._easel.send(tr.MatchScene())
        else:
            self._preview = _Work(request.maker, request.arguments)

    def _use(self, request: tq.MatchUse) -> None:
        self._wanted.append(_Work(request.maker, request.arguments, request.name))

    def _drop(self, work: _Work) -> None:
        if work is self._preview:
            self._preview = None
        if work in self._wanted:
            self._wanted.remove(work)

    # --- steps -------------------------------------------------------------------------------------------------------

    def _advance(self, work: _Work) -> None:
        if work.plan is None:
            work.plan = self._read(work)
            work.steps = _when_ready(work.plan) if work.name else _seen_soon(work.plan)
            same = self._preview if work.name else None
            if same is not None and same.finished and _alike(work, same):
                work.done, work.colours, work.finished = 1.0, same.colours, True
            elif not work.name:
                self._show_examples(work.plan)
            return
        assert work.steps is not None
        made = next(work.steps, None)
        if made is None:
            self._end(work)
            return
        if made.colours is None and made.done == work.done:
            return  # nothing new
        work.done = made.done
        if made.colours is not None:
            work.colours = made.colours
            if not work.name:
                self._show("match texture", made.colours)
        if made.colours is not None or not work.name:
            self._tell(work)

    def _end(self, work: _Work) -> None:
        """Ends a texture that is made; of one that is looked at, what is copied is counted first."""
        if work.name or not work.structured:
            work.finished = True
            return
        assert work.plan is not None
        assert work.colours is not None
        if work.counting is None:
            example = with_structure.looked_at(work.plan.examples[0].planes)
            work.counting = counted_copies(example, work.colours)
            return
        share = next(work.counting)
        if share is not None:
            work.copied, work.finished = share, True
            self._tell(work)

    def _read(self, work: _Work) -> Plan:
        return heeger_bergen.read(work.maker, Fields(thawed(work.arguments), ""), self._pictures)

    def _define(self, work: _Work) -> None:
        assert work.plan is not None
        assert work.colours is not None
        sample = heeger_bergen.sample(work.plan, work.colours)
        source = ImageSource.of(work.name, sample.rgba)
        found = sample.found.update(work.arguments).set("examples", sample.found["examples"])
        self._easel.carry_out(c.DefineTexture(work.name, work.maker, found.set("sha", source.sha)), source)
        self._tell(self._preview or work)

    # --- what the panel sees -----------------------------------------------------------------------------------------

    def _show_examples(self, plan: Plan) -> None:
        shas = tuple(example.sha for example in plan.examples)
        if shas != self._shown:
            self._shown = shas
            for name, example in zip(("match example", "match second"), plan.examples, strict=False):
                self._show(name, example.planes)

    def _show(self, name: str, planes: np.ndarray) -> None:
        """Sends planes (1, 3 or 4, h, w) of 0..1."""
        out = np.full((*planes.shape[1:], 4), 255, np.uint8)
        scaled = np.clip(planes, 0.0, 1.0) * np.float32(255) + np.float32(0.5)
        out[..., : max(len(planes), 3)] = scaled.astype(np.uint8).transpose(1, 2, 0)
        self._easel.send(results.Picture(name, results.frozen(out)))

    def _tell(self, work: _Work) -> None:
        plan = work.plan
        if plan is None:
            return
        pattern = heeger_bergen.pattern_of(replace(plan, bands=(), axes=()))
        sizes = tuple((example.planes.shape[2], example.planes.shape[1]) for example in plan.examples)
        making = self._wanted[0].name if self._wanted else ""
        shape = pattern.shape
        self._easel.send(
            tr.MatchScene(
                work.done, shape.levels, shape.orientations, _colours(pattern), sizes, making=making, copied=work.copied
            )
        )


def _seen_soon(plan: Plan) -> Iterator[heeger_bergen.Made]:
    """Yields the steps of a plan; of one with a structure first those to a texture that is soon made, repeated until it
    is as large."""
    begun = 0.0
    if plan.structure != with_structure.NO_STRUCTURE:
        begun = _SOON
        for made in heeger_bergen.steps(heeger_bergen.quick(plan)):
            colours = None if made.colours is None else _repeated(made.colours, plan.size)
            yield heeger_bergen.Made(begun * made.done, colours)
    for made in _when_ready(plan):
        yield heeger_bergen.Made(begun + (1.0 - begun) * made.done, made.colours)


def _when_ready(plan: Plan) -> Iterator[heeger_bergen.Made]:
    """Yields the steps of a plan; of one with a structure once its kernels are there, and on a thread of their own."""
    if plan.structure == with_structure.NO_STRUCTURE:
        yield from heeger_bergen.steps(plan)
        return
    yield from structure_ready.waiting(0.0)
    done = 0.0
    for made in taken_beside(heeger_bergen.steps(plan)):
        done = done if made is None else made.done
        yield heeger_bergen.Made(done) if made is None else made


def _repeated(planes: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    rows, columns = (np.arange(n) % m for n, m in zip(size, planes.shape[1:], strict=True))
    out: np.ndarray = planes[:, rows][:, :, columns]
    return out


def _alike(one: _Work, other: _Work) -> bool:
    """Tells whether both make the same texture."""
    assert one.plan is not None
    same = other.plan is not None and (one.plan.examples, one.plan.shape) == (other.plan.examples, other.plan.shape)
    return same and (one.maker, one.arguments) == (other.maker, other.arguments)


def _colours(pattern: Pattern) -> tuple[tuple[float, float, float], ...]:
    """Returns what the axes of colour look like: their mean and a standard deviation to the brighter side."""
    axes = pattern.colours.coarse if isinstance(pattern.colours, SplitColours) else pattern.colours
    assert isinstance(axes, ColourAxes)
    found = []
    for column in axes.axes[:3].T:
        step = column / max(float(np.abs(column).max()), 1e-6) * 0.35
        r, g, b = np.broadcast_to(np.clip(0.5 + step, 0.0, 1.0), (3,))
        found.append((float(r), float(g), float(b)))
    return tuple(found)


class _Pictures:
    """Pictures that were read already, while their files and the painting stay as they are."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._known: dict[tuple[Any, ...], tuple[Group | None, np.ndarray]] = {}

    @property
    def arithmetic(self) -> int:
        """Gives the painting's."""
        return self._easel.session.painting.arithmetic

    def picture(self, members: Fields) -> np.ndarray:
        session = self._easel.session
        root = session.painting.root if "rect" in members else None
        key = (json.dumps(_naming(members), sort_keys=True), *self._stamp(members))
        known = self._known.get(key)
        if known is None or known[0] is not root:
            found = PictureSource(session.folder, session.painting.root).picture(members)
            while len(self._known) >= _KEPT:
                self._known.pop(next(iter(self._known)))
            known = self._known[key] = root, found
        return known[1]

    def _stamp(self, members: Fields) -> tuple[int, ...]:
        """By which a file that was written again is told."""
        path = members.all().get("path")
        if not isinstance(path, str):
            return ()
        try:
            found = os.stat(path if self._easel.session.folder is None else Path(self._easel.session.folder) / path)
        except (OSError, ValueError):
            return ()
        return found.st_mtime_ns, found.st_size


def _naming(members: Fields) -> dict[str, Any]:
    return {name: members.all().get(name) for name in ("path", "rect", "layer", "detail")}
