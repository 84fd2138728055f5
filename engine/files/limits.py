"""How much a file may ask for before it is refused.

A file's numbers are claims of a stranger: each is compared with its limit before memory or time is spent on it.
The figures leave room for every real file known to us and keep the worst case within what a machine can hold.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Limits:
    """Caps on what is read; all sizes in bytes unless the name says otherwise."""

    file: int = 64 << 30  # a file as a whole
    side: int = 1 << 18  # pixels along a side of one image
    pixels: int = 400_000_000  # of one image
    total_pixels: int = 2_000_000_000  # of all layers of one file, from their headers, before any is decoded
    chunk: int = 16 << 20  # one PNG chunk that is kept in memory; image data streams and is not kept
    chunks: int = 1_000_000  # PNG chunks in one file
    entries: int = 20_000  # members of an archive
    name: int = 1024  # of a member
    directory: int = 16 << 20  # of the central directory
    ratio: int = 1100  # inflated : stored; deflate itself cannot exceed 1032
    xml: int = 8 << 20  # stack.xml
    elements: int = 20_000  # of stack.xml
    depth: int = 64  # nesting of groups
    layers: int = 2_000  # layers and groups
    text: int = 4096  # characters of one attribute
    offset: int = 1 << 31  # |x|, |y| of a layer, pixels
    json: int = 16 << 20  # our own manifest
    log: int = 1 << 30  # the recording inside a painting: larger ones are left out


LIMITS = Limits()
STREAMED = 1 << 30  # pixels of one image whose rows are put away on disk as they are read


def streamed(limits: Limits) -> Limits:
    """Returns the limits of an image whose rows are put away on disk as they are read: wider, unless narrower ones than
    usual were asked for."""
    return replace(limits, pixels=STREAMED) if limits.pixels == LIMITS.pixels else limits


def memory_cap() -> int:
    """Returns bytes that the paint of one file may take: three quarters of the machine's memory."""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 4 * 3
    except (ValueError, OSError, AttributeError):
        return 6 << 30
