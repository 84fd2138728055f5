"""What the background worker works at: a session, the stroke in progress, and the tiles that the screen wants.

Tiles are functions of the painting alone.  Which of those on the screen are old is found by comparing paintings.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from engine.canvas.composite import composite
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.layers import Layer
from engine.numeric.address import Rect
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.painting import documents, swatches
from engine.painting import requests as q
from engine.painting.difference import areas
from engine.painting.examine import Examiner
from engine.painting.lab import Lab
from engine.painting.matcher import Matcher
from engine.painting.outline import rows
from engine.painting.points import rounded
from engine.painting.ready import ready
from engine.painting.session import Session
from engine.painting.sight import Key, Sight, tile_rect
from engine.painting.stroke import LiveStroke
from engine.painting.value import Painting


class Easel:
    """The engine's side of the post.  All calls come from one thread."""

    def __init__(self, send: Callable[[q.Result], None]) -> None:
        self.send = send
        self.session = Session()
        self.path: Path | None = None
        self.live: LiveStroke | None = None
        self.sight = Sight()
        self.due: float | None = None  # when a recording that plays goes on
        self._serial = 0
        self._saved: Painting | None = self.session.painting
        self._dirty = Rect(0, 0, 0, 0)  # pixels of the live stroke's level not sent yet
        self._dirty_level = 0
        self._script: documents.Playing | None = None
        self._known = True  # whether the session's log leads from nothing to the painting
        self._writers: list[threading.Thread] = []
        self._telling = threading.Lock()
        self._handlers: dict[type, Callable[[Any], None]] = {
            q.New: self._new,
            q.Open: self._open_file,
            q.Save: self._save,
            q.Export: self._export,
            q.Do: lambda r: self.carry_out(r.command),
            q.Begin: self._begin,
            q.Points: lambda r: self.extend(rounded(r.points)),
            q.Finish: lambda r: self.finish(),
            q.Abandon: lambda r: self._abandon(),
            q.Swatch: self._swatch,
            q.Pick: self._pick,
        }
        self.lab, self.examiner, self.matcher = Lab(self), Examiner(self), Matcher(self)
        self._handlers |= self.lab.handlers | self.examiner.handlers | self.matcher.handlers
        send(ready())
        self._tell()

    # --- requests ----------------------------------------------------------------------------------------------------

    def do(self, request: q.Request) -> None:
        """Carries out a request that changes something; sends its results."""
        if self._script is not None and self._script.drawing:
            if isinstance(request, q.Points | q.Finish | q.Abandon):
                return  # of a stroke that was refused
            if isinstance(request, q.Begin | q.Do | q.Save):
                self._script.complete(self)  # what is asked for comes after the recording's stroke, not into it
        self._handlers[type(request)](request)

    def look(self, request: q.Look) -> None:
        """Takes over what is wanted on the screen."""
        self.sight.look(request)

    @property
    def revision(self) -> int:
        """How often the picture has changed."""
        return self.sight.revision

    @property
    def pending(self) -> int:
        return (
            len(self.sight.open)
            + (not self._dirty.empty)
            + self.lab.pending
            + self.examiner.pending
            + self.matcher.pending
        )

    def step(self) -> bool:
        """The most urgent piece of open work: what the pen just painted, then the lab's pictures, tiles, textures being
        matched, analysis."""
        if not self._dirty.empty:
            self._send_dirty()
        elif self.lab.pending:
            self.lab.step()
        elif self.sight.open:
            self._bring_up_to_date(self.sight.open.popleft())
        elif self.matcher.pending:
            self.matcher.step()
        elif self.examiner.pending:
            self.examiner.step()
        else:
            return False
        return True

    def close(self) -> None:
        """Waits for files that are being written."""
        for writer in self._writers:
            writer.join()

    # --- the painting ------------------------------------------------------------------------------------------------

    def _new(self, request: q.New) -> None:
        self.show(Session(Painting(frame=request.frame, seed=request.seed)), None)

    def show(self, session: Session, path: Path | None) -> None:
        """Another painting is on the easel."""
        self.live, self._script, self.due, self._known = None, None, None, True
        self.session, self.path = session, path
        self._saved = session.painting
        self._serial += 1
        self.sight.forget()
        self._dirty = Rect(0, 0, 0, 0)
        self._tell()
        self.sight.changed(lambda level: None)

    def carry_out(self, command: c.Command) -> None:
        """A command; what it changed on the screen is brought up to date."""
        if self.live is not None:
            self.finish()
        before = self.session.painting
        after = self.session.do(command)
        if after is not before:
            self.sight.changed(areas(before, after))
        self._tell()

    def _begin(self, request: q.Begin) -> None:
        self.lab.settle()
        self.begin(c.Stroke(request.level, request.origin, np.empty((0, 6)), request.brush))

    def begin(self, stroke: c.Stroke) -> None:
        """The pen touches down; the stroke's points come later."""
        if self.live is not None:
            self.finish()
        self.live = self.session.begin(stroke.level, stroke.origin, stroke.brush, stroke.layer, stroke.seed)
        self.live.extra = stroke.extra
        self._dirty_level = stroke.level

    def extend(self, points: np.ndarray) -> None:
        """More of the stroke.  Only the paint is laid; pictures of it follow when no more points wait."""
        if self.live is None:  # its beginning was refused
            return
        rect = self.live.add(points)
        if rect.empty:
            return
        level = self.live.level
        more = not self._dirty.empty  # one change for all points between two pictures
        self._dirty = dirty = self._dirty.union(rect)
        self.sight.grew(lambda n: [dirty] if n == level else [], more)
        if self.live.full:
            stroke = self.live.to_command()
            self.finish()
            self.begin(replace(stroke, points=points[:0]))

    def finish(self) -> None:
        """The pen lifts."""
        live, self.live = self.live, None
        self._dirty = Rect(0, 0, 0, 0)  # what is not sent yet comes with the tiles, which are all looked at again
        if live is None:
            return
        try:
            after = self.session.finish(live)
        except Exception:
            self._unsee(live)  # its preview is on the screen, and will not be paint
            raise
        other = areas(live.base, after)
        # At the stroke's own level the preview is what was committed: nothing changes.
        self.sight.changed(lambda level: [] if level == live.level else other(level))
        self._tell()

    def _abandon(self) -> None:
        live, self.live = self.live, None
        if live is not None:
            self._unsee(live)
            self._dirty = Rect(0, 0, 0, 0)

    def _unsee(self, live: LiveStroke) -> None:
        """The preview of a stroke that came to nothing goes from the screen."""
        self.sight.changed(lambda level: [live.rect] if level == live.level else [])

    def _tell(self) -> None:
        """Sends what the panels show.  Files that were written tell as well, from their own threads: in turn, so that
        the last one sent is the newest."""
        with self._telling:
            self.send(self._scene())

    def _scene(self) -> q.Scene:
        painting = self.session.painting
        return q.Scene(
            frame=painting.frame,
            layers=tuple(rows(painting.root)),
            active=painting.active,
            can_undo=self.session.can_undo,
            can_redo=self.session.can_redo,
            modified=painting is not self._saved,
            path=self.path,
            textures=tuple(sorted(painting.textures)),
            texture_kinds=tuple((name, texture.kind) for name, texture in painting.textures.items()),
            definitions=tuple((name, texture.kind, texture.parameters) for name, texture in painting.textures.items()),
            texture_widths=tuple((name, t.source.width) for name, t in painting.textures.items() if t.source),
            serial=self._serial,
        )

    # --- tiles -------------------------------------------------------------------------------------------------------

    def _send_dirty(self) -> None:
        """The part of the wanted tiles that the stroke in progress changed."""
        dirty, level, self._dirty = self._dirty, self._dirty_level, Rect(0, 0, 0, 0)
        for key in self.sight.meeting(level, dirty):
            self._bring_up_to_date(key)

    def _bring_up_to_date(self, key: Key) -> None:
        """Sends a wanted tile anew, or the part of it that changed since the window's copy, or that it is good."""
        part = self.sight.old_part(key)
        if part is None:
            return
        revision = self.sight.revision
        if part.empty:
            self.sight.sent(key)
            self.send(q.Same((key,), revision))
            return
        tile = tile_rect(key)
        pixels = q.frozen(to_premul8(self.picture(key[0], part)))
        self.sight.sent(key)
        inner = Rect(part.x0 - tile.x0, part.y0 - tile.y0, part.x1 - tile.x0, part.y1 - tile.y0)
        self.send(q.Patch(key, inner, pixels, revision))

    def picture(self, level: int, whole: Rect) -> np.ndarray:
        """What is to be seen of a rectangle: float32 (4, h, w), premultiplied; with the stroke in progress."""
        root = self.live.base.root if self.live is not None else self.session.painting.root
        known: dict[int, np.ndarray | None] = {}

        def read(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
            if layer.id not in known:  # once for all blocks: they share most of what lies above them
                known[layer.id] = self._read(layer, level, whole)
            planes = known[layer.id]
            return None if planes is None else planes[:, *rect.slices(whole)]

        return composite(root, level, whole, read)

    def _read(self, layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
        live = self.live
        if (
            live is not None
            and not live.empty
            and layer.name == live.layer.name
            and level == live.level
            and rect.meets(live.rect)
        ):
            return live.preview(rect).rgba
        found = evaluate_sparse(layer.pyramid, level, rect, self.session.cache)
        return None if found is None else found.rgba

    def _pick(self, request: q.Pick) -> None:
        pixel = self.picture(request.level, Rect.at(request.x, request.y, 1, 1))[:, 0, 0]
        alpha = float(pixel[3])
        r, g, b = (float(min(1.0, max(0.0, v / alpha))) if alpha > 0 else 0.0 for v in pixel[:3])
        self.send(q.Picked((r, g, b), alpha))

    def _swatch(self, request: q.Swatch) -> None:
        pixels = swatches.painted(request, self.session.painting)
        self.send(q.Picture(request.ident, q.frozen(to_premul8(pixels))))

    # --- files -------------------------------------------------------------------------------------------------------

    def _open_file(self, request: q.Open) -> None:
        found = documents.opened(request.path, request.live)
        self.show(found.session, found.path)
        self._known, self._script = found.known, found.script
        self.due = None if found.script is None else 0.0
        if found.script is not None:
            self.send(q.Note(f"Playing {request.path.name}"))
        elif found.notes:
            self.send(q.Note(f"{request.path.name}: {found.notes[0]}", bad=True))

    def play(self) -> None:
        """The next piece of a recording that plays."""
        assert self._script is not None
        if self.live is not None and not self._script.drawing:  # a hand draws: its stroke comes first
            self.due = time.monotonic() + documents.PIECE
            return
        self.due = self._script.advance(self)
        if self.due is None:
            self._script = None
            self._saved = None if self.session.log else self.session.painting
            self._tell()
            self.send(q.Note("The recording has ended"))

    def _save(self, request: q.Save) -> None:
        """Writes on a thread of its own, from the painting as it is now; painting goes on meanwhile."""
        if self.live is not None:
            self.finish()
        painting = self.session.painting
        recording = self.session.recording() if self._known else None
        serial = self._serial

        def write() -> None:
            documents.save(request.path, painting, recording)
            if serial == self._serial:  # the same painting is still on the easel
                self.path, self._saved = request.path, painting
                self._tell()
            self.send(q.Saved(request.path))

        self._in_background(write)

    def _export(self, request: q.Export) -> None:
        painting = self.session.painting

        def write() -> None:
            documents.write_picture(request, painting)
            self.send(q.Note(f"Wrote {request.path.name}"))

        self._in_background(write)

    def _in_background(self, write: Callable[[], None]) -> None:
        def run() -> None:
            try:
                write()
            except Exception as error:
                self.send(q.Note(str(error).partition("\n")[0] or type(error).__name__, bad=True))
            finally:
                self.send(q.Pending(self.pending, 0))

        self._writers = [w for w in self._writers if w.is_alive()]
        self._writers.append(threading.Thread(target=run, name="inkfall file", daemon=False))
        self.send(q.Pending(self.pending, 1))
        self._writers[-1].start()
