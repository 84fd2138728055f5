"""What can be made again and is kept for a while all the same, since it is most likely asked for soon."""

from __future__ import annotations

from typing import Protocol

from engine.archive.shelves.filed_pages import PAGES_READ
from engine.archive.shelves.shelf import DECODED
from engine.canvas.attenuate import RENEWED
from engine.numeric.memo import REMEMBERED
from engine.session.coding.coded_records import RECORDS_MADE, SHEETS_MADE
from engine.session.coding.coded_tiles import TILES_MADE
from engine.texture.expression.kept_squares import SQUARES


class _Holder(Protocol):
    """Somebody who keeps such."""

    @property
    def held(self) -> int:
        """Returns the bytes that are held now."""
        ...

    def shrink(self, by: int) -> None:
        """Forgets so many bytes, as far as there are any."""
        ...


_HOLDERS: tuple[_Holder, ...] = DECODED, SHEETS_MADE, RECORDS_MADE, TILES_MADE, PAGES_READ, RENEWED, SQUARES, REMEMBERED


def forget_made(by: int) -> None:
    """Forgets so many bytes of each kind, as far as there are any."""
    for holder in _HOLDERS:
        holder.shrink(by)


def made_held() -> int:
    """Counts the bytes of all that is kept."""
    return sum(holder.held for holder in _HOLDERS)
