"""The easel: the painting that is worked on, the stroke in progress, and what the window sees of both."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np

from engine.canvas.growth import Growth
from engine.canvas.layers import Group
from engine.checks.owned import Owned
from engine.keeping import collecting
from engine.numeric.address import Rect
from engine.numeric.arithmetic import NEWEST
from engine.painting import commands as c
from engine.painting.difference import areas
from engine.painting.recording import Header
from engine.painting.value import first_painting
from engine.session.session import Session
from engine.strokes.example_stroke import Live
from engine.studio import results
from engine.studio.outline import rows
from engine.studio.viewer import Viewer
from engine.texture.image import ImageSource

_NO_GROWTH = Rect(0, 0, 0, 0)


class Easel(Owned):
    """A session with the stroke in progress.  It belongs to the engine's thread.

    `path`: the file of the painting, None for none; `name`: what one without a file is called; `saved`: the session's
    state that this file holds, None for none; `serial`: another number, another painting.
    """

    def __init__(self, send: Callable[[results.Result], None]) -> None:
        self.send = send
        self.session = Session(first_painting(Header(arithmetic=NEWEST)))
        self.live: Live | None = None
        self.path: Path | None = None
        self.name = ""
        self.aside: list[Callable[[], Iterable[Group]]] = []  # what tell of states that are kept beside the painting
        self.session.room.aside = self.aside  # where memory is short, they go to disk before what is seen
        self.saved: object = self.session.state
        self.serial = 0
        self._growth = _NO_GROWTH
        self.viewer = Viewer(self)

    @property
    def modified(self) -> bool:
        """Tells whether the painting is another one than its file holds."""
        return self.session.state is not self.saved

    def show(self, session: Session, path: Path | None, modified: bool = False) -> None:
        """Puts another painting on the easel; `modified`: it is another one than its file holds."""
        session.heard, session.room.aside = self.session.heard, self.aside
        self.live, self.session = None, session
        self.path, self.name, self.saved = path, "", None if modified else session.state
        self.serial += 1
        self.viewer.forget()
        self.tell()
        self.viewer.changed(lambda level: None)
        collecting.look_anew()

    def carry_out(self, command: c.Command, lent: ImageSource | None = None) -> None:
        """Does a command, after the stroke in progress; what it changed on the screen is brought up to date.

        `lent`: the picture that a definition names by its sha, where it need not be made again.
        """
        if self.live is not None:
            self.finish()
        self.viewer.look_back(None)
        before = self.session.painting
        after = self.session.do(command, lent)
        if after is not before:
            self.viewer.changed(areas(before, after))
        self.tell()

    # --- the stroke in progress --------------------------------------------------------------------------------------

    def begin(self, stroke: c.Stroke) -> None:
        """Begins a stroke whose points come later."""
        if self.live is not None:
            self.finish()
        self.viewer.look_back(None)
        about = stroke.layer, stroke.seed, stroke.copies, stroke.onto, stroke.seen
        self.live = self.session.begin(stroke.level, stroke.origin, stroke.brush, *about)
        self.live.extra = stroke.extra
        self._growth = _NO_GROWTH

    def extend(self, points: np.ndarray) -> None:
        """Lays more of the stroke.  Only the paint is laid; pictures of it follow when no more points wait."""
        if self.live is None:  # its beginning was refused
            return
        self._grew(self.live.add(points))
        if self.live.full:
            stroke, asked = self.live.to_command(), self.live.asked
            self.finish()
            self.begin(replace(stroke, points=points[:0]))
            assert self.live is not None
            self.live.asked = asked

    def finish(self) -> None:
        """Commits the stroke."""
        self.follow()
        live, self.live = self.live, None
        if live is None:
            return
        try:
            after = self.session.finish(live)
        except Exception:
            self.viewer.unsee(live)  # its preview is on the screen, and will not be paint
            raise
        if live.predictor is not None:
            self.send(results.Note(f"Continued by a filter of reach {live.predictor.reach}: {live.predictor.verdict}"))
        if live.flattened:
            self.viewer.changed(areas(live.before, after))
            self.tell()
            return
        other, own = areas(live.base, after), live.level  # the stroke itself, with its coverage, is not to be kept
        # At the stroke's own level the preview is what was committed: nothing changes.
        self.viewer.changed(lambda level: [] if level == own else other(level))
        self.tell()

    def abandon(self) -> None:
        """Drops the stroke as if it had not been."""
        live, self.live = self.live, None
        if live is not None:
            self.viewer.unsee(live)

    @property
    def behind(self) -> bool:
        """Tells whether the stroke laid dabs of an example that cannot be seen yet."""
        return self.live is not None and self.live.bed is not None and self.live.bed.behind

    def follow(self) -> None:
        """Makes them seen, at the coarsest level."""
        if self.live is not None and self.live.bed is not None and self.live.bed.behind:
            self._grew(self.live.bed.follow())

    def refined(self, growth: Growth) -> None:
        """Takes over what the stroke grows, further refined."""
        assert self.live is not None
        assert self.live.bed is not None
        self._grew(self.live.bed.follow(growth))

    def _grew(self, area: Rect) -> None:
        if self.live is not None and not area.empty:
            self._growth = self._growth.union(area)
            self.viewer.grew(self.live.level, self.live.areas or [area])

    def taken_growth(self) -> Rect:
        """Returns, once, where the stroke in progress has grown since this was asked for, in pixels of its level."""
        grown, self._growth = self._growth, _NO_GROWTH
        return grown

    # --- what is seen ------------------------------------------------------------------------------------------------

    def picture(self, level: int, whole: Rect) -> np.ndarray:
        """Returns what is to be seen of a rectangle: float32 (4, h, w), premultiplied; with the stroke in progress."""
        return self.viewer.picture(level, whole)

    def tell(self) -> None:
        """Sends what the panels show."""
        painting = self.session.painting
        scene = results.Scene(
            frame=painting.frame,
            layers=tuple(rows(painting.root)),
            paper=painting.paper,
            active=painting.active,
            can_undo=self.session.can_undo,
            can_redo=self.session.can_redo,
            modified=self.modified,
            path=self.path,
            textures=tuple(sorted(painting.textures)),
            texture_kinds=tuple((name, texture.kind) for name, texture in painting.textures.items()),
            definitions=tuple((name, texture.kind, texture.parameters) for name, texture in painting.textures.items()),
            texture_widths=tuple((name, t.source.width) for name, t in painting.textures.items() if t.source),
            serial=self.serial,
            name=self.name,
            bookmarks=tuple(painting.bookmarks.values()),
            guides=tuple(painting.guides.values()),
            grid=painting.grid,
            touches=painting.touches,
        )
        self.send(scene)
