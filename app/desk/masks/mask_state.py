"""Which mask is painted on in place of its layer's paint."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from engine.painting.layering.onto_member import ONTO_MASK, ONTO_PAINT
from engine.studio.masked.mask_requests import ShowMask
from engine.studio.requests import Request
from engine.studio.results import LayerRow


@dataclass(slots=True)
class MaskState:
    """`layer`: the name of the layer or group whose mask is painted on while that is active, None for none; `alone`:
    it is seen in place of the painting; `coming`: the name of the one whose mask is painted on once it is there."""

    layer: str | None = None
    alone: bool = False
    coming: str | None = None

    def on(self, row: LayerRow | None) -> bool:
        """Tells whether the mask of the active layer is painted on."""
        return row is not None and row.masked and row.name == self.layer

    def onto(self, row: LayerRow | None) -> str:
        """Returns what strokes and fills go to."""
        return ONTO_MASK if self.on(row) else ONTO_PAINT

    def begin(self, post: Callable[[Request], None], name: str, alone: bool = False) -> None:
        """Paints on a mask from now on; shows it `alone`."""
        self.layer = name
        self.show(post, alone)

    def end(self, post: Callable[[Request], None]) -> None:
        """Paints on layers again."""
        self.layer = None
        self.show(post, False)

    def show(self, post: Callable[[Request], None], alone: bool) -> None:
        """Shows the mask alone, or the painting."""
        if alone or self.alone:
            post(ShowMask(self.layer if alone else None))
        self.alone = alone

    def follow(self, post: Callable[[Request], None], row: LayerRow | None) -> None:
        """Begins where a mask came that was waited for; ends where another layer is active, or the mask is gone."""
        if self.coming is not None and (row is None or row.name != self.coming or row.masked):
            found, self.coming = self.coming, None
            if row is not None and row.name == found:
                self.begin(post, found)
        if self.layer is not None and not self.on(row):
            self.end(post)
