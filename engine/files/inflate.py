"""Inflating a stream of unknown honesty: never more at a time than was asked for."""

from __future__ import annotations

from collections.abc import Iterator

from isal import igzip_lib

ZLIB = igzip_lib.DECOMP_ZLIB
RAW = igzip_lib.DECOMP_DEFLATE
PIECE = 1 << 16  # compressed bytes to hand over at a time


class DeflateError(Exception):
    """The compressed bytes are not deflate, or their checksum is wrong."""


class Inflated:
    """A deflate stream, given as pieces of any size, read as plain bytes on demand."""

    def __init__(self, pieces: Iterator[bytes], form: int = ZLIB) -> None:
        self._pieces = pieces
        self._stream = igzip_lib.IgzipDecompressor(flag=form)

    def readinto(self, view: memoryview) -> int:
        """Fills `view` (bytes); fewer only where the stream ends.  DeflateError on damage."""
        filled = 0
        while filled < len(view) and not self._stream.eof:
            piece = self._next()
            if piece is None:
                break
            out = self._step(piece, len(view) - filled)
            view[filled : filled + len(out)] = out
            filled += len(out)
        return filled

    def finish(self) -> bool:
        """To be called after the last wanted byte: False if the stream stops short of its end mark and checksum.

        A stream that goes on beyond the wanted bytes is not followed to its end.
        """
        while not self._stream.eof:
            piece = self._next()
            if piece is None:
                return False
            if self._step(piece, 1):
                return True
        return True

    def _next(self) -> bytes | None:
        if not self._stream.needs_input:
            return b""
        return next(self._pieces, None)

    def _step(self, piece: bytes, limit: int) -> bytes:
        try:
            return self._stream.decompress(piece, limit)
        except igzip_lib.IsalError as error:  # type: ignore[misc]  # its stub lacks the base class
            raise DeflateError(str(error)) from error
