"""What a fill would make of the active layer, shown in sight before it is asked for."""

from __future__ import annotations

from dataclasses import replace

from engine.brush.checks import BrushError
from engine.canvas import layers
from engine.canvas.layers import Layer
from engine.canvas.node_checks import LayerError
from engine.checks.owned import Owned
from engine.painting.fill_command import Fill, Like
from engine.painting.value import Refusal
from engine.session.apply import apply
from engine.strokes.all_painted import level_for_all
from engine.strokes.filling import filled
from engine.studio import requests as q
from engine.studio.adjusting.trial_records import Tried, TryFill
from engine.studio.easel import Easel
from engine.studio.results import Note


class Trials(Owned):
    """It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._asked: TryFill | None = None
        self._told: tuple[object, str] | None = None  # for which painting the level was told
        self.handlers: q.Handlers = {TryFill: self._ask}

    @property
    def pending(self) -> bool:
        """Tells whether something is to be shown."""
        asked = self._asked
        return asked is not None and (asked.texture is None or not self._easel.viewer.sight.open)

    def step(self) -> None:
        """Shows what was asked for last."""
        request, self._asked = self._asked, None
        if self._easel.live is not None:
            return
        if request is None or request.brush is None or request.area is None:
            self._easel.viewer.look_back(None)
            return
        session = self._easel.session
        painting = session.painting
        try:
            if request.texture is None:
                self._tell_level()
            like = Like((request.area.x0, request.area.y0), request.level, request.area, 1.0, 0, False)
            ground = painting if request.texture is None else apply(painting, request.texture, session.around())
            seen = filled(ground, Fill(request.brush, like, open=True, onto=request.onto), session.cache)
            seen = painting if seen is ground else seen
        except (Refusal, LayerError, BrushError) as error:
            self._easel.send(Note(str(error), bad=True))
            seen = painting
        self._easel.viewer.look_back(None if seen is painting else replace(seen, active=painting.active))

    def _ask(self, request: TryFill) -> None:
        self._asked = request

    def _tell_level(self) -> None:
        painting = self._easel.session.painting
        node = None if painting.active is None else layers.find(painting.root, painting.active)
        if not isinstance(node, Layer) or self._told == (painting, node.name):
            return
        self._told = painting, node.name
        self._easel.send(Tried(node.name, level_for_all(node.pyramid, self._easel.session.cache)))
