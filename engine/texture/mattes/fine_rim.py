"""The rim of what was found, at full size: how far each pixel of a band belongs to it, and its colours without the
ground, piece by piece and from coarse to fine."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from scipy import ndimage

from engine.numeric.address import Rect
from engine.texture.mattes.closed_form import solved
from engine.texture.mattes.patchwork import reduced

BAND = 16  # pixels on either side of the rim, at most
_SIDE, _MARGIN = 256, 32  # pixels along a piece, and around it
_FINER = 4  # by which a picture grows from one pass to the next, at most
_REACH, _LEAST = 2.0, 3.0  # of the band, in pixels of the coarser picture; and pixels at least
_UNSURE = 0.04  # alpha so far from 0 and 1 is looked at anew
_DATA, _TRACE = 0.1, 0.01  # how much colours count beside the windows, and what was found before
_CLEAR, _FRAYED, _WORN = 0.6, 0.2, 0.6  # trust in colours, and how far they are from ground, and from inside
_NOISE = 0.02  # of a camera, beside which colours are to differ
_NOTHING = 0.02  # alpha that is none, or all


class Piece(NamedTuple):
    """A part of the picture whose rim is found: alpha float32 (h, w), colours float32 (h, w, 3); `done`: the part of
    all pieces that were looked at by then, 0..1."""

    done: float
    rect: Rect
    alpha: np.ndarray
    colours: np.ndarray


def sizes(size: tuple[int, int], small: tuple[int, int]) -> list[tuple[int, int]]:
    """Returns heights and widths of the pictures that are looked at one after the other, up to the whole one."""
    ratio = max(size[0] / small[0], size[1] / small[1])
    passes = 1
    while ratio > _FINER**passes:
        passes += 1
    ladder = [ratio ** (k / passes) for k in range(1, passes)]
    return [(min(size[0], round(small[0] * r)), min(size[1], round(small[1] * r))) for r in ladder] + [size]


def laid_out(size: tuple[int, int], near: tuple[float, float]) -> list[Rect]:
    """Returns the pieces of a picture of a height and width, from a place on, told as parts of width and height."""
    whole, x0, y0 = Rect(0, 0, size[1], size[0]), near[0] * size[1], near[1] * size[0]
    found = [
        Rect.at(x, y, _SIDE, _SIDE).intersect(whole) for y in range(0, size[0], _SIDE) for x in range(0, size[1], _SIDE)
    ]
    return sorted(found, key=lambda r: (2 * x0 - r.x0 - r.x1) ** 2 + (2 * y0 - r.y0 - r.y1) ** 2)


def alphas(
    pixels: np.ndarray, trace: np.ndarray, said: np.ndarray, size: tuple[int, int], near: tuple[float, float]
) -> Iterator[Piece]:
    """Yields pieces of the picture `pixels`, uint8 or uint16 RGBA (H, W, 4), reduced to a size, wherever its rim is,
    `near` a place first; `trace`: float32 (h, w), alpha as a coarser picture has it; `said`: int8 (k, l), where it is
    as that has it."""
    full = int(np.iinfo(pixels.dtype).max)
    picture = pixels if size == pixels.shape[:2] else reduced(pixels, *size)
    coarse = max(size[0] / trace.shape[0], size[1] / trace.shape[1], 1.0)
    whole = Rect(0, 0, size[1], size[0])
    pieces = laid_out(size, near)
    for n, rect in enumerate(pieces):
        around = rect.grown(_MARGIN).intersect(whole)
        first = stretched(trace, size, around)
        if not (first.max() > _NOTHING and first.min() < 1 - _NOTHING):
            continue
        rgb = _coloured(picture[around.slices(whole)], full)
        held = stretched(np.abs(said).astype(np.float32), size, around) > 0.5
        alpha, colours = _piece(rgb, first, held, coarse)
        inner = rect.slices(around)
        yield Piece((n + 1) / len(pieces), rect, alpha[inner], colours[inner])


def stretched(trace: np.ndarray, size: tuple[int, int], rect: Rect) -> np.ndarray:
    """Returns a part of values (h, w) stretched to a size, linearly: float32."""
    rows = (np.arange(rect.y0, rect.y1) + 0.5) * trace.shape[0] / size[0] - 0.5
    columns = (np.arange(rect.x0, rect.x1) + 0.5) * trace.shape[1] / size[1] - 0.5
    low, part = _between(rows, trace.shape[0])
    left, across = _between(columns, trace.shape[1])
    upper, lower = trace[low], trace[np.minimum(low + 1, trace.shape[0] - 1)]
    both = upper + part[:, None] * (lower - upper)
    one, other = both[:, left], both[:, np.minimum(left + 1, trace.shape[1] - 1)]
    return np.asarray(one + across * (other - one), np.float32)


def _between(places: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    places = np.clip(places, 0, count - 1)
    low = places.astype(np.int64)
    return low, (places - low).astype(np.float32)


def _coloured(pixels: np.ndarray, full: int) -> np.ndarray:
    found: np.ndarray = pixels[..., :3].astype(np.float32) / np.float32(full)
    return found


def _piece(rgb: np.ndarray, first: np.ndarray, held: np.ndarray, coarse: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns alpha and colours of a piece; `first`: alpha as the coarser picture has it, `coarse` times as coarse;
    `held`: where it is to be as it is there."""
    inside = first > 0.5
    far = _distance(inside)
    band = far <= min(BAND, max(_LEAST, _REACH * coarse))
    band |= (np.abs(first - inside) > _UNSURE) & (far <= BAND)
    alpha = inside.astype(np.float32)
    if band.any():
        band = (band | _frayed(rgb, inside, far)) & ~held
    if band.any():
        wanted, weights = _by_colours(rgb, inside, band, far)
        weights, trust = _DATA * weights, _TRACE * (1 - weights)
        target = (weights * wanted + trust * first) / (weights + trust)
        begin = np.where(band, target, alpha)
        alpha[band] = np.clip(solved(rgb, band, begin, weights + trust, target), 0.0, 1.0)
    alpha[alpha < _NOTHING], alpha[alpha > 1 - _NOTHING] = 0.0, 1.0
    return alpha, colours_without(rgb, alpha)


def _distance(inside: np.ndarray) -> np.ndarray:
    """Returns how far each pixel is from the other side."""
    if inside.all() or not inside.any():
        return np.full(inside.shape, np.inf)
    found: np.ndarray = ndimage.distance_transform_edt(inside) + ndimage.distance_transform_edt(~inside) - 0.5
    return found


def _frayed(rgb: np.ndarray, inside: np.ndarray, far: np.ndarray) -> np.ndarray:
    """Tells where, farther from the rim, colours say clearly that a pixel is of both, or of the other side."""
    about = far <= BAND
    wanted, trust = _by_colours(rgb, inside, about, far)
    other = about & (trust > _CLEAR) & np.where(inside, wanted < 1 - _WORN, wanted > _FRAYED)
    found: np.ndarray = ndimage.median_filter(other.view(np.uint8), 3).astype(np.bool_)
    return found


def _by_colours(
    rgb: np.ndarray, inside: np.ndarray, band: np.ndarray, far: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Returns alpha as colours alone tell it, between what is nearby inside and on the ground, and how much is to be
    thought of that, 0..1."""
    wide = max(2.0, float(far[band].max()))
    (front, rough), (back, coarse) = (_nearby(rgb, side & ~band, wide) for side in (inside, ~inside))
    apart = front - back
    length = (apart**2).sum(axis=-1) + 1e-9
    along = ((rgb - back) * apart).sum(axis=-1) / length
    alpha = np.clip(along, 0.0, 1.0)
    left = rgb - back - alpha[..., None] * apart
    spread = _NOISE**2 + alpha * rough + (1 - alpha) * coarse
    fits = np.exp(-0.5 * (left**2).sum(axis=-1) / (spread + 1e-9) / 3)
    trust = fits * length / (length + 9.0 * spread)
    return alpha.astype(np.float32), trust.astype(np.float32)


def _nearby(rgb: np.ndarray, known: np.ndarray, wide: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns the mean of known colours near each pixel, and how much these vary."""
    weight = _blurred(known.astype(np.float32), wide) + np.float32(1e-8)
    mean, varied = np.empty_like(rgb), np.zeros(rgb.shape[:2], np.float32)
    for c in range(3):
        plane = np.where(known, rgb[..., c], np.float32(0))
        mean[..., c] = _blurred(plane, wide) / weight
        varied += _blurred(plane * plane, wide) / weight - mean[..., c] ** 2
    return mean, np.maximum(varied, 0.0)


def _blurred(values: np.ndarray, wide: float) -> np.ndarray:
    """Returns means about each pixel, (h, w), by three running means: nearly a Gaussian of a deviation `wide`."""
    size = 2 * round(wide) + 1
    for _ in range(3):
        values = ndimage.uniform_filter(values, size, mode="nearest")
    return values


def colours_without(rgb: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """Returns colours without the ground's part, float32 (h, w, 3), by blurs wide and narrow (Forte & Pitié 2021)."""
    front, back = rgb, rgb
    for wide in (12.0, 2.0):
        front, back = _fused(rgb, alpha, front, back, wide)
    return np.where(alpha[..., None] >= 1.0, rgb, np.clip(front, 0.0, 1.0)).astype(np.float32)


def _fused(
    rgb: np.ndarray, alpha: np.ndarray, front: np.ndarray, back: np.ndarray, wide: float
) -> tuple[np.ndarray, np.ndarray]:
    within, without = _blurred(alpha, wide) + np.float32(1e-6), _blurred(1 - alpha, wide) + np.float32(1e-6)
    near, under = np.empty_like(rgb), np.empty_like(rgb)
    for c in range(3):
        near[..., c] = _blurred(front[..., c] * alpha, wide) / within
        under[..., c] = _blurred(back[..., c] * (1 - alpha), wide) / without
    a = alpha[..., None]
    return near + a * (rgb - a * near - (1 - a) * under), under
