"""Checkpoints: the painting beside its journal, so that little of that is to be carried out again.

Two generations take turns: the older one stays until the newer one is synced, read back, and told in the journal.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from isal import isal_zlib

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.archive.saving_turn import SAVING
from engine.canvas import layers
from engine.canvas.layers import Layer
from engine.checks.roles import COPIED
from engine.files.fault import FileError
from engine.journal.records import Members
from engine.journal.story import Checkpoint
from engine.numeric.address import Rect
from engine.painting.value import Painting

_BLOCK = 1 << 20  # bytes
_NO_FRAME = Rect(0, 0, 1, 1)  # what other programs would see of it is not drawn


def checkpoint_file(folder: Path, generation: int) -> Path:
    """Returns the file of a generation."""
    return folder / f"checkpoint-{generation % 2}.ora"


def write_checkpoint(
    folder: Path, generation: int, painting: Painting, cancelled: Callable[[], bool] | None = None
) -> Members:
    """Writes a painting, grown to its end, without its recording, but with what was copied last, as a hidden layer;
    returns what the journal is to tell of the file besides the number of commands.  WriteError or Cancelled if it was
    not written, as where a painting is being written elsewhere."""
    place = checkpoint_file(folder, generation)
    root, held = painting.root, painting.copied
    if held is not None:
        held = replace(held, id=layers.next_id(root), name=layers.unique_name(root), visible=False, role=COPIED)
        root = layers.insert(root, held, None, 0)
    with SAVING.taken_if_free():  # it must not wait: who has the turn may wait for the thread that writes this
        save(place, Snapshot(replace(painting, root=root, frame=_NO_FRAME)), cancelled=cancelled)
    size, crc = _sums(place)
    return {"generation": generation, "size": size, "crc": crc, **({} if held is None else {"copied": held.name})}


def read_checkpoint(
    folder: Path, found: Checkpoint, frame: Rect, progress: Callable[[float], None] | None = None
) -> Painting | None:
    """Returns the painting of a checkpoint, with its frame; None if its file is another one by now, or damaged.
    `progress` hears of the part that is read; what it raises ends that."""
    place = checkpoint_file(folder, found.generation)
    with suppress(OSError, FileError, MemoryError):
        if _sums(place) == (found.size, found.crc):
            opened = open_painting(place, progress)
            if opened.native:
                return _lifted(replace(opened.painting, frame=frame), found.copied)
    return None


def _lifted(painting: Painting, name: str | None) -> Painting:
    """Returns a painting that holds what was copied last, no longer in a layer of that name."""
    if name is None or not layers.has(painting.root, name):
        return painting
    held = layers.find(painting.root, name)
    assert isinstance(held, Layer)
    root = layers.remove(painting.root, name)
    return replace(painting, root=root, copied=replace(held, visible=True, role=""))


def _sums(path: Path) -> tuple[int, int]:
    """Returns the bytes of a file, and their CRC-32."""
    found = 0
    with open(path, "rb") as file:
        while block := file.read(_BLOCK):
            found = isal_zlib.crc32(block, found)
        return os.fstat(file.fileno()).st_size, found
