"""The files that films are written to: through the user's own ffmpeg, through Pillow, and as a picture a frame."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

import numpy as np

from engine.files.atomic import part_folder, replacing
from engine.files.fault import FileError, WriteError, system_words
from engine.files.png_writer import write_png
from engine.film.shooting import Shooting
from engine.keeping.unfinished import unfinished
from engine.painting.rendering import Progress, Stop, check_cancelled

MOST_FRAMES = 600  # of an animated picture
FRAME_BYTES = 1 << 30  # of all its frames: Pillow holds them until the file is written
_NUMBERED = re.compile(r"%0?(\d*)d")

Frames = Iterator[np.ndarray]


class Format(NamedTuple):
    """How films are written that end so.  `most_fps`: more cannot be told; `bounded`: in frames; `even`: sides have to
    be; `ffmpeg`: what that needs to be told, None where Pillow writes it with `saving`."""

    name: str
    most_fps: float
    bounded: bool
    even: bool = False
    ffmpeg: tuple[str, ...] = ()
    saving: tuple[tuple[str, int], ...] = ()


_BT709 = ("-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709")
_X264 = ("-c:v", "libx264", "-preset", "medium", "-crf", "18", "-movflags", "+faststart", "-f", "mp4")
_VP9 = ("-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-row-mt", "1", "-cpu-used", "4", "-f", "webm")
FORMATS: dict[str, Format] = {
    ".mp4": Format("MP4", 240.0, False, True, _X264),
    ".webm": Format("WebM", 240.0, False, True, _VP9),
    ".webp": Format("WEBP", 240.0, True, saving=(("quality", 85), ("method", 4))),
    ".avif": Format("AVIF", 240.0, True, saving=(("quality", 70), ("speed", 8))),
    ".gif": Format("GIF", 50.0, True),
    ".png": Format("PNG", 240.0, True),
}


class Settled(NamedTuple):
    """A film as it can be written, and a line that tells in what it is another one than was asked for, or nothing."""

    shooting: Shooting
    note: str = ""


def writable(path: str | os.PathLike[str], shooting: Shooting) -> Settled:
    """Returns a film as it can be written to a file; FileError if that cannot be so, WriteError without ffmpeg."""
    row, film = _format(path), shooting.film
    if row is None:
        return Settled(shooting)
    if row.even and (film.size[0] % 2 or film.size[1] % 2):
        raise FileError(path, f"found {film.size[0]} x {film.size[1]} pixels, expected even sides for {row.name}")
    if row.ffmpeg and shutil.which("ffmpeg") is None:
        raise WriteError(
            path, f"found no ffmpeg on the path, which writes {row.name}; expected it, or .webp, .avif, .gif"
        )
    fps, note = min(film.fps, row.most_fps), ""
    if row.bounded:
        most = max(1, min(MOST_FRAMES, FRAME_BYTES // (3 * film.size[0] * film.size[1])))
        fps = min(fps, most / shooting.seconds)
        if fps * shooting.seconds < shooting.count - 0.5 and fps < min(film.fps, row.most_fps):
            note = f"{row.name} holds at most {most} frames of this size: {fps:.3g} a second instead of {film.fps:g}"
    if fps == film.fps:
        return Settled(shooting)
    return Settled(shooting.slower(fps), note or f"{row.name} shows at most {fps:g} frames a second, not {film.fps:g}")


def write_film(
    path: str | os.PathLike[str],
    shooting: Shooting,
    progress: Progress = None,
    cancelled: Stop = None,
    threads: int | None = None,
) -> None:
    """Shoots a film into a file, or into numbered ones.  Their places hold what was there, or all of the new.

    `progress` gets the part done, 0..1.  WriteError on failure, FileError if a recording cannot be played, Cancelled
    if `cancelled()` becomes true.
    """
    row = _format(path)
    frames = _shot(shooting, progress, cancelled, threads)
    with unfinished(Path(path)):
        if row is None:
            _write_series(Path(path), frames)
        elif row.ffmpeg:
            _encode(path, row, shooting, frames)
        else:
            _animate(path, row, shooting, frames)


def _shot(shooting: Shooting, progress: Progress, cancelled: Stop, threads: int | None) -> Frames:
    """Yields the frames, tells how far that is, and looks before each whether they are still wanted."""
    for i, frame in enumerate(shooting.frames(threads)):
        check_cancelled(cancelled)
        yield frame
        if progress is not None:
            progress((i + 1) / shooting.count)


def is_series(path: str | os.PathLike[str]) -> bool:
    """Tells whether a path names a picture for each frame, by `%05d` or its like."""
    return _NUMBERED.search(Path(path).name) is not None


def _format(path: str | os.PathLike[str]) -> Format | None:
    """Returns how a path is written; None for numbered pictures."""
    ending = Path(path).suffix.lower()
    if is_series(path):
        if ending != ".png" or len(_NUMBERED.findall(Path(path).name)) > 1:
            raise FileError(path, f"found numbered files ending in {ending!r}, expected one %05d and .png")
        return None
    row = FORMATS.get(ending)
    if row is None:
        raise FileError(path, f"found the ending {ending!r}, expected one of {', '.join(FORMATS)}, or NAME-%05d.png")
    return row


def _encode(path: str | os.PathLike[str], row: Format, shooting: Shooting, frames: Frames) -> None:
    """Hands frames to ffmpeg, which writes where `replacing` says."""
    program = shutil.which("ffmpeg")
    assert program is not None
    width, height = shooting.film.size
    given = ("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", f"{shooting.film.fps:.6g}")
    colours = ("-vf", "scale=out_color_matrix=bt709:out_range=tv", "-pix_fmt", "yuv420p", *_BT709)
    with replacing(path) as file, tempfile.TemporaryFile() as told:
        words = [program, "-v", "error", "-nostdin", "-y", *given, "-i", "-", *colours, *row.ffmpeg, str(file.name)]
        # A session of its own: Ctrl+C is for us to deal with.
        encoder = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=told, stderr=told, start_new_session=True)
        assert encoder.stdin is not None
        try:
            with suppress(BrokenPipeError):
                for frame in frames:
                    encoder.stdin.write(frame.data)
                encoder.stdin.close()
            failed = encoder.wait() != 0
        finally:
            encoder.kill()
            encoder.wait()
            with suppress(OSError):
                encoder.stdin.close()
        if failed:
            told.seek(0)
            lines = told.read().decode(errors="replace").strip().splitlines()
            raise WriteError(path, f"ffmpeg cannot write it: {lines[-1] if lines else 'it ended'}")


def _animate(path: str | os.PathLike[str], row: Format, shooting: Shooting, frames: Frames) -> None:
    """Has Pillow write an animated picture."""
    from PIL import Image, features

    if row.name in ("AVIF", "WEBP") and not features.check(row.name.lower()):
        raise WriteError(path, f"found a Pillow without {row.name}, expected one with it, or .gif or .png")
    with replacing(path) as file:
        images = [Image.fromarray(frame) for frame in frames]
        step = 10 if row.name == "GIF" else 1  # milliseconds that a duration is told in
        ends = [round(1000 * (i + 1) / shooting.film.fps / step) * step for i in range(len(images))]
        durations = [int(b - a) for a, b in zip([0, *ends], ends, strict=False)]
        rest, saving = images[1:], dict(row.saving)
        images[0].save(file, row.name, save_all=True, append_images=rest, duration=durations, loop=0, **saving)


def _write_series(path: Path, frames: Frames) -> None:
    """Writes a picture for each frame beside their places, then puts all there."""
    digits = int(_NUMBERED.findall(path.name)[0] or 0)
    try:
        folder = part_folder(path)
        try:
            names = []
            for i, frame in enumerate(frames):
                names.append(_NUMBERED.sub(str(i).zfill(digits), path.name))
                with open(folder / names[-1], "wb") as file:
                    write_png(file, frame)
            for name in names:
                os.replace(folder / name, path.parent / name)
        finally:
            shutil.rmtree(folder, ignore_errors=True)
    except OSError as error:
        raise WriteError(path, f"cannot be written: {system_words(error)}") from None
