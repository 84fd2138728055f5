"""What the painting and all about it hold in memory, told to the window now and then."""

from __future__ import annotations

import time

from engine.canvas.layers import layers
from engine.checks.owned import Owned
from engine.keeping import memory
from engine.keeping.spill import spill
from engine.painting.value import Painting
from engine.session.coding.made_again import made_held
from engine.session.held_pyramids import pyramids
from engine.session.session import Session
from engine.studio.easel import Easel
from engine.studio.held.held_records import Held

_APART = 2.0  # seconds between two results, at least
_SHARE = 50  # and so many times what it takes to count
_CHANGED = 4 << 20  # bytes by which the process grew or shrank that are worth telling


class Holding(Owned):
    """Tells it.  It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._next = 0.0  # when it may be told again
        self._resident = 0  # that was told

    def tell(self) -> None:
        """Sends what is held, if it was not told of late and is another."""
        begun = time.monotonic()
        if begun < self._next:
            return
        resident = memory.resident()
        if abs(resident - self._resident) >= _CHANGED:
            self._resident = resident
            self._easel.send(Held(held_by(self._easel.session), resident, memory.budget(), spill().held))
        ended = time.monotonic()
        self._next = ended + max(_APART, _SHARE * (ended - begun))


def held_by(session: Session) -> tuple[tuple[str, int], ...]:
    """Returns who holds how many bytes, in the words of who paints."""
    painting = session.painting
    return (
        ("Painting", sum(pyramid.nbytes for pyramid in pyramids(painting.root).values())),
        ("Undo", session.history.held),
        ("What is on the screen", session.cache.held),
        ("Pictures", _pictures(painting)),
        ("Strokes as they were drawn", session.log.held),
        ("Made again when it is asked for", made_held()),
    )


def _pictures(painting: Painting) -> int:
    """Counts the bytes of the pictures that textures are made of, and of those that layers began with."""
    sources = {source.sha: source.pixels for t in painting.textures.values() for source in t.pictures}
    grounds = (layer.pyramid.ground for layer in layers(painting.root))
    return sum(pixels.nbytes for pixels in sources.values() if pixels is not None) + sum(
        len(ground.pixels) for ground in grounds if ground is not None
    )
