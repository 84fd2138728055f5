"""The loop that lays an ink under tints: B of a tile, worked out in the part of each row that the stroke covers."""

from __future__ import annotations

import numpy as np

from engine.numeric.grid import snap
from engine.numeric.kernel import Array, inner_uncounted, kernel

_ZERO = np.float32(0.0)


@inner_uncounted
def _add_part(out: Array, factor: Array, under: Array, line: Array, c: int, fresh: bool) -> None:
    """out += factor (low + slope under), after nothing if `fresh`; `line`: low and slope, (2, 3)."""
    low, slope = line[0, c], line[1, c]
    if fresh:
        for i in range(out.shape[0]):
            out[i] = factor[i] * (low + slope * under[i])
    else:
        for i in range(out.shape[0]):
            out[i] += factor[i] * (low + slope * under[i])


@inner_uncounted
def _add_seen(out: Array, amplitude: Array, seen: Array) -> None:
    for i in range(out.shape[0]):
        out[i] += amplitude[i] * seen[i]


@inner_uncounted
def _glaze_row(weight: Array, colour: Array, out: Array, first: int) -> None:
    """Writes B of a row from a column on; beside that it is cleared."""
    last = first + weight.shape[0]
    out[:first] = _ZERO
    out[last:] = _ZERO
    b = out[first:last]
    for i in range(b.shape[0]):
        b[i] = snap(weight[i] * colour[i])


@kernel
def dye(
    weight: Array,
    tints: Array,
    shifts: Array,
    terms: Array,
    amplitudes: Array,
    seen: Array,
    shown: Array,
    add: Array,
) -> None:
    """B = snap(weight (C + sum f a s)), and of amplitudes snap(weight f a), C and the factors f being the `tints`,
    float32 (3 + p, h, w), `weight` float32 (h, w), `add` float32 (4 + k, h, w), of which alpha is left alone.

    `shifts`, float32 (p, 2, 3): of each part, by how much it changes C over black, and how much more over white;
    `terms`, int64 (t, 2): a part and one of its instances, and `amplitudes`, (t, 2, 3), likewise; `seen`, float32
    (s, h, w): what instances look like; `shown`, int64 (n, 4): which planes of it are each one's red, green and blue,
    and the first plane of `add` that is its own, -1 for none.
    """
    colours, found = np.empty(weight.shape[1], np.float32), np.empty(weight.shape[1], np.float32)
    for y in range(weight.shape[0]):
        first, last = 0, weight.shape[1]  # beside these nothing weighs anything
        while first < last and weight[y, first] == _ZERO:
            first += 1
        while first < last and weight[y, last - 1] == _ZERO:
            last -= 1
        w, colour, row = weight[y, first:last], colours[: last - first], found[: last - first]
        for c in range(3):
            under = tints[c, y, first:last]
            colour[:] = under
            for p in range(shifts.shape[0]):
                _add_part(colour, tints[3 + p, y, first:last], under, shifts[p], c, False)
            for n in range(shown.shape[0]):
                fresh = True
                for t in range(terms.shape[0]):
                    if terms[t, 1] == n:
                        _add_part(row, tints[3 + terms[t, 0], y, first:last], under, amplitudes[t], c, fresh)
                        fresh = False
                _add_seen(colour, row, seen[shown[n, c], y, first:last])
                if shown[n, 3] >= 0:
                    _glaze_row(w, row, add[shown[n, 3] + c, y], first)
            _glaze_row(w, colour, add[c, y], first)
