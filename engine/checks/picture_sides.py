"""How large things may be that several parts agree on."""

from __future__ import annotations

PICTURE_SIDE = 1 << 20  # pixels that an exported picture may have each way: a strip of this width takes 256 MB
