"""The sheet of the texture doctor: the example and what every maker made of it, the one that suits it framed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from app.cli.match_command import pixels_of

if TYPE_CHECKING:
    from engine.makers.doctor.examining import Report

_CELL, _BETWEEN, _WORDS = 256, 20, 46  # pixels: of a picture, between pictures, below each for its words
_COLUMNS = 4
_BACK, _TEXT, _FAINT, _BEST = (24, 25, 28), (226, 227, 230), (140, 143, 150), (255, 170, 80)


def doctor_sheet(report: Report) -> np.ndarray:
    """Returns the whole sheet: uint8 RGB (h, w, 3)."""
    from engine.makers.doctor.trying import TRIED

    kinds = ", ".join(report.kinds) or "of one colour"
    cells: list[tuple[str, str, np.ndarray | None, bool]] = [("Example", kinds, report.example, False)]
    for trial in report.trials:
        words = trial.fault
        if trial.likeness is not None:
            words = f"{trial.likeness.apart:.2f} apart, {trial.likeness.copied:.0%} copied, {trial.seconds:.2f} s"
        cells.append((TRIED[trial.way].title, words, trial.colours, trial.way == report.advice))
    rows = -(-len(cells) // _COLUMNS)
    width = _BETWEEN + _COLUMNS * (_CELL + _BETWEEN)
    lines = _lines(report.why, width - 2 * _BETWEEN)
    page = Image.new("RGB", (width, _BETWEEN + rows * (_CELL + _WORDS + _BETWEEN) + 22 * len(lines)), _BACK)
    draw = ImageDraw.Draw(page)
    for i, (title, words, colours, best) in enumerate(cells):
        x = _BETWEEN + i % _COLUMNS * (_CELL + _BETWEEN)
        y = _BETWEEN + i // _COLUMNS * (_CELL + _WORDS + _BETWEEN)
        if colours is not None:
            _put(page, colours, (x, y))
        if best:
            draw.rectangle((x - 4, y - 4, x + _CELL + 3, y + _CELL + 3), outline=_BEST, width=3)
        draw.text((x, y + _CELL + 18), title, _BEST if best else _TEXT, _letters(15), anchor="ls")
        draw.text((x, y + _CELL + 36), words[:44], _FAINT, _letters(12), anchor="ls")
    for n, line in enumerate(lines):
        draw.text((_BETWEEN, page.height - 22 * (len(lines) - n)), line, _TEXT, _letters(15), anchor="lt")
    return np.asarray(page)


def _put(page: Image.Image, colours: np.ndarray, place: tuple[int, int]) -> None:
    """Puts a picture (C, h, w) in a cell, pixel for pixel."""
    pixels = pixels_of(colours, 8)
    mode = {1: "L", 3: "RGB", 4: "RGBA"}[pixels.shape[2]]
    shown = Image.fromarray(pixels[..., 0] if mode == "L" else pixels).convert("RGBA")
    page.paste(shown, place, shown)


def _letters(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size)


def _lines(words: str, width: int) -> list[str]:
    """Breaks a sentence into lines that fit."""
    out = [""]
    for word in words.split():
        longer = f"{out[-1]} {word}".strip()
        if out[-1] and _letters(15).getlength(longer) > width:
            out.append(word)
        else:
            out[-1] = longer
    return out
