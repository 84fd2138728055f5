"""The sheet of an analysis: picture, false colours, spectra and autocorrelation side by side."""

from __future__ import annotations

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from engine.numeric.analysis import Analysis, middle

SIDE, GAP, HEAD = 320, 20, 30  # pixels: of a panel, between panels, above each for its title
_PAPER, _FRAME, _INK, _SOFT = (24, 25, 28), (60, 62, 68), (226, 227, 230), (140, 143, 150)
_MEASURED, _FITTED = (120, 190, 255), (255, 170, 80)
_DECADES = 6.0  # of power that the spectra show
# Dark to light through violet and orange: points of a ramp for spectra.
_RAMP = np.array([(8, 6, 18), (66, 20, 98), (150, 42, 92), (226, 96, 44), (252, 180, 60), (252, 250, 200)], float)


def sheet(found: Analysis) -> np.ndarray:
    """Returns the whole sheet: uint8 RGB (h, w, 3)."""
    height, width = found.pixels.shape[:2]
    whole = max(height, width) <= max(found.grey.shape)
    shown = f"{width} x {height} pixels" if whole else f"middle of {width} x {height} pixels"
    panels = [
        (f"Picture: {shown}", _shown(_eight_bit(middle(found.pixels, _side(found))))),
        (
            f"Regions in false colours: {found.regions:,}",
            _shown(middle(found.false_coloured, _side(found)), whole=True),
        ),
        ("Autocorrelation", _signed(found.autocorrelation)),
        ("Power spectrum", _shown(_spectrum(found.power))),
        ("All-pole (AR) spectrum", _shown(_spectrum(found.all_pole, found.power))),
        ("Power by frequency", _curves(found)),
    ]
    columns = 3
    rows = -(-len(panels) // columns)
    page = Image.new("RGB", (GAP + columns * (SIDE + GAP), GAP // 2 + rows * (HEAD + SIDE + GAP)), _PAPER)
    draw = ImageDraw.Draw(page)
    for i, (title, panel) in enumerate(panels):
        x, y = GAP + i % columns * (SIDE + GAP), GAP // 2 + i // columns * (HEAD + SIDE + GAP)
        draw.text((x, y + HEAD - 8), title, _INK, _font(15), anchor="ls")
        page.paste(panel, (x, y + HEAD))
        draw.rectangle((x - 1, y + HEAD - 1, x + SIDE, y + HEAD + SIDE), outline=_FRAME)
    return np.asarray(page)


def _side(found: Analysis) -> int:
    """Returns the side of what the spectra were made of, so that all panels show the same part."""
    side: int = max(found.grey.shape)
    return side


def _font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size)


def _eight_bit(pixels: np.ndarray) -> np.ndarray:
    return pixels if pixels.dtype == np.uint8 else (pixels >> 8).astype(np.uint8)


def _shown(pixels: np.ndarray, whole: bool = False) -> Image.Image:
    """RGB or RGBA (h, w, c) fitted into a panel: small pictures are enlarged by whole pixels; large ones made smaller
    by means, or, where means tell nothing, by leaving `whole` pixels out."""
    height, width = pixels.shape[:2]
    panel = Image.new("RGB", (SIDE, SIDE), tuple(c + 10 for c in _PAPER))
    scale = SIDE / max(height, width)
    size = max(1, round(width * scale)), max(1, round(height * scale))
    how = Image.Resampling.NEAREST if whole or scale >= 1 else Image.Resampling.BOX
    picture = Image.fromarray(np.ascontiguousarray(pixels)).convert("RGBA").resize(size, how)
    panel.paste(picture, ((SIDE - size[0]) // 2, (SIDE - size[1]) // 2), picture)
    return panel


def _spectrum(power: np.ndarray, like: np.ndarray | None = None) -> np.ndarray:
    """Returns the logarithm of a spectrum by the ramp, RGB; on the scale of another, if one is given."""
    top = float((power if like is None else like).max())
    if not top > 0.0:
        return _ramped(np.zeros(power.shape))
    values = 1.0 + np.log10(np.maximum(power / top, 1e-30)) / _DECADES
    return _ramped(np.clip(values, 0.0, 1.0))


def _ramped(values: np.ndarray) -> np.ndarray:
    at = np.linspace(0.0, 1.0, len(_RAMP))
    return np.stack([np.interp(values, at, _RAMP[:, c]) for c in range(3)], axis=-1).astype(np.uint8)


def _signed(values: np.ndarray) -> Image.Image:
    """-1..1 as blue to grey to orange; far displacements, which few pixels tell of, are left out."""
    height, width = (max(1, n // 2) for n in values.shape)
    inner = np.clip(values[(values.shape[0] - height) // 2 :, (values.shape[1] - width) // 2 :][:height, :width], -1, 1)
    ends = np.array([(40, 110, 220), (70, 71, 74), (255, 200, 120)], float)
    colours = np.stack([np.interp(inner, (-1, 0, 1), ends[:, c]) for c in range(3)], axis=-1)
    return _shown(colours.astype(np.uint8))


def _curves(found: Analysis) -> Image.Image:
    """Returns mean power over frequency, both logarithmic: measured and all-pole."""
    panel = Image.new("RGB", (SIDE, SIDE), tuple(c + 10 for c in _PAPER))
    draw, font = ImageDraw.Draw(panel), _font(12)
    frequencies, measured, fitted = found.radial
    top = float(measured.max(initial=0.0))
    if len(frequencies) < 2 or not top > 0.0:
        draw.text((SIDE / 2, SIDE / 2), "too little to tell", _SOFT, font, anchor="mm")
        return panel
    left, right, upper, lower = 34, SIDE - 12, 14, SIDE - 26
    low = float(frequencies[0])

    def place(f: float, power: float) -> tuple[float, float]:
        x = left + (right - left) * np.log(f / low) / np.log(0.5 / low)
        decades = np.log10(max(power / top, 1e-30))
        return float(x), float(upper + (lower - upper) * min(max(-decades / _DECADES, -0.02), 1.0))

    for decade in range(int(_DECADES) + 1):
        y = upper + (lower - upper) * decade / _DECADES
        draw.line((left, y, right, y), _FRAME)
        draw.text((left - 5, y), f"-{decade}" if decade else "0", _SOFT, font, anchor="rm")
    for period in (2, 4, 8, 16, 32, 64, 128, 256, 512):
        if 1 / period >= low:
            x, _ = place(1 / period, top)
            draw.line((x, upper, x, lower), _FRAME)
            draw.text((x, lower + 5), str(period), _SOFT, font, anchor="mt")
    for values, colour, y in ((measured, _MEASURED, 22), (fitted, _FITTED, 38)):
        draw.line([place(f, p) for f, p in zip(frequencies, values, strict=True)], colour, 2)
        draw.text((right - 6, y), "measured" if colour == _MEASURED else "all-pole", colour, font, anchor="rm")
    draw.text((left + 4, lower - 4), "period in pixels; power in decades", _SOFT, font, anchor="ls")
    return panel
