"""Compiled loops of the code of tiles (engine/archive/tilecode.py)."""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import Array, Int, Real, inlined, inner_uncounted, short, uncounted

STREAMS = 7
PIECE_WIDTH = 32  # pixels
SQUARE_SIDE = 16  # pixels along the side
FITTED = 2  # of the rows, by which gains are found
CODES = 6  # widths of a piece
DIFFERENCES = 4  # of differences
SAMPLED = 4  # of the rows, by which those are chosen
GAINS = 2
_BITS = 8  # of a gain behind the point
_MOST = (1 << 15) - 1
_ALPHA = 3
_WORTH = 0.12  # of the squares that gains take away: of less, they cost more bits than they save


@inlined
def _abs(value: np.int32) -> np.int32:
    """|value| of an int32, as one."""
    sign = np.int32(value >> np.int32(31))
    return np.int32(np.int32(value ^ sign) - sign)


@inlined
def _plane(number: Int) -> Int:
    """The plane that comes at a place in the order: alpha before red, green and blue."""
    if number == 0:
        return _ALPHA
    return number - 1 if number <= _ALPHA else number


@inner_uncounted
def _sums(row: np.ndarray, before: np.ndarray) -> tuple[np.int32, np.int32, np.int32, np.int32]:
    """Returns the sums of a row's absolute differences, of each kind.

    They are cast to int32 at every step, since sums of it are int64 otherwise, which takes twice as long; where that
    wraps, beyond all values of pixels, another kind is chosen than the best.
    """
    v, u = np.int32(row[0]), np.int32(before[0])
    none, left, above, both = _abs(v), _abs(v), _abs(np.int32(v - u)), _abs(np.int32(v - u))
    width = row.size
    here, beside, up, corner = row[1:], row[: width - 1], before[1:], before[: width - 1]
    for i in range(width - 1):
        v, u = np.int32(here[i]), np.int32(up[i])
        step = np.int32(v - np.int32(beside[i]))
        none = np.int32(none + _abs(v))
        left = np.int32(left + _abs(step))
        above = np.int32(above + _abs(np.int32(v - u)))
        both = np.int32(both + _abs(np.int32(np.int32(step - u) + np.int32(corner[i]))))
    return none, left, above, both


@inner_uncounted
def _kind(data: Array, sums: Array) -> Int:
    """0 to 3: which differences of a tile (planes, h, w) have the smallest sum of absolute values on every
    `SAMPLED`-th row; `sums`, int64 (4,), is written to."""
    height = data.shape[1]
    sums[:] = 0
    for p in range(data.shape[0]):
        for y in range(min(1, height - 1), height, SAMPLED):
            none, left, above, both = _sums(data[p, y], data[p, max(y - 1, 0)])
            sums[0] += none
            sums[1] += left
            sums[2] += above
            sums[3] += both
    best = 0
    for k in range(1, DIFFERENCES):
        if sums[k] < sums[best]:
            best = k
    return best


@inner_uncounted
def _differences(plane: np.ndarray, kind: Int, out: np.ndarray) -> bool:
    """Writes a plane less what `kind` names into `out` int32 (h, w); tells whether any of it is not zero."""
    width, found = plane.shape[1], np.int32(0)
    for y in range(plane.shape[0]):
        row, line = plane[y], out[y]
        for i in range(width):
            line[i] = np.int32(row[i])
        if kind >= 2 and y > 0:
            before = plane[y - 1]
            for i in range(width):
                line[i] -= np.int32(before[i])
        if kind == 1 or kind == 3:
            for i in range(width - 1, 0, -1):
                line[i] -= line[i - 1]
        for i in range(width):
            found |= line[i]
    return found != 0  # type: ignore[no-any-return]


@inner_uncounted
def _gain_of(own: Array, alpha: Array, before: Array, y: Int, x: Int) -> tuple[Int, Int]:
    """Returns the gains of alpha's and of the plane before's differences, in units of 2^-8, that leave the smallest
    squares of a plane's own on a square."""
    aa, ab, bb, va, vb, vv = np.int64(0), np.int64(0), np.int64(0), np.int64(0), np.int64(0), np.int64(0)
    last = min(x + SQUARE_SIDE, own.shape[1])
    for j in range(y, min(y + SQUARE_SIDE, own.shape[0]), FITTED):
        v, a, b = own[j][x:last], alpha[j][x:last], before[j][x:last]
        for i in range(v.size):
            f, g, h = np.int64(v[i]), np.int64(a[i]), np.int64(b[i])
            aa += g * g
            ab += g * h
            bb += h * h
            va += f * g
            vb += f * h
            vv += f * f
    return _solved(np.float64(aa), np.float64(ab), np.float64(bb), np.float64(va), np.float64(vb), np.float64(vv))


@inlined
def _solved(aa: Real, ab: Real, bb: Real, va: Real, vb: Real, vv: Real) -> tuple[Int, Int]:
    """Returns the gains of two planes by their sums of products; of planes that go together only alpha's."""
    scale = np.float64(1 << _BITS)
    rest = aa * bb - ab * ab
    if rest > np.float64(1e-6) * aa * bb:
        first, second = (va * bb - vb * ab) / rest, (vb * aa - va * ab) / rest
    elif aa > 0.0:
        first, second = va / aa, np.float64(0.0)
    elif bb > 0.0:
        first, second = np.float64(0.0), vb / bb
    else:
        first, second = np.float64(0.0), np.float64(0.0)
    if first * va + second * vb < _WORTH * vv:
        first, second = np.float64(0.0), np.float64(0.0)
    limit = np.float64(_MOST)
    return (
        np.int32(np.rint(min(max(first * scale, -limit), limit))),
        np.int32(np.rint(min(max(second * scale, -limit), limit))),
    )


@inner_uncounted
def _spread(gains: Array, place: Int, across: Int, line: Array) -> np.int32:
    """Writes the gains of a row of squares, one each from `place` on, for every pixel into `line` (w,); gives all their
    bits."""
    bits = np.int32(0)
    for k in range(across):
        here, gain = line[SQUARE_SIDE * k : min(SQUARE_SIDE * (k + 1), line.size)], np.int32(gains[place + k])
        for i in range(here.size):
            here[i] = gain
        bits |= gain
    return bits


@inner_uncounted
def _add_given(alpha: Array, before: Array, first: Array, second: Array, sign: Int, row: Array, out: Array) -> None:
    """out = row + sign times what other planes say of a row of differences, int32, wrapping."""
    half, bits = np.int32(1 << (_BITS - 1)), np.int32(_BITS)
    for i in range(out.size):
        both = np.int32(np.int32(first[i] * alpha[i]) + np.int32(second[i] * before[i]))
        out[i] = np.int32(row[i] + np.int32(sign * np.int32(np.int32(both + half) >> bits)))


@inner_uncounted
def _zigzag(line: np.ndarray, z: np.ndarray) -> np.uint32:
    """`line` int32 zigzag-coded into `z` uint32; all its bits together."""
    bits = np.uint32(0)
    for i in range(line.size):
        v = line[i]
        z[i] = np.uint32(np.int32(v << np.int32(1)) ^ np.int32(v >> np.int32(31)))
        bits = np.uint32(bits | z[i])
    return bits


@inner_uncounted
def _put(z: np.ndarray, width: Int, bits: np.uint32, streams: np.ndarray, at: np.ndarray) -> Int:
    """Appends a piece to its stream, `at` (STREAMS,) being where each ends; the code of its width."""
    if bits == 0:
        return 0
    if bits < 4:
        n = (width + 3) // 4
        out = streams[0][at[0] : at[0] + n]
        for i in range(n):
            out[i] = z[4 * i] | (z[4 * i + 1] << 2) | (z[4 * i + 2] << 4) | (z[4 * i + 3] << 6)
        at[0] += n
        return 1
    if bits < 16:
        n = (width + 1) // 2
        out = streams[1][at[1] : at[1] + n]
        for i in range(n):
            out[i] = z[2 * i] | (z[2 * i + 1] << 4)
        at[1] += n
        return 2
    count, first = 1, 2
    if bits >= 256:
        count, first = (2, 3) if bits < 65536 else (4, 3)
    for b in range(count):
        out = streams[first + b][at[first + b] : at[first + b] + width]
        for i in range(width):
            out[i] = np.uint8(z[i] >> np.uint32(8 * b))
        at[first + b] += width
    return 3 if count == 1 else 3 + count // 2


@inner_uncounted
def _put_row(line: Array, z: Array, codes: Array, streams: Array, at: Array) -> None:
    """Appends a row, int32 (w,), to the streams; its codes, one for each piece."""
    for k in range(codes.size):
        piece = line[PIECE_WIDTH * k : min(PIECE_WIDTH * (k + 1), line.size)]
        n = piece.size
        bits = _zigzag(piece, z)
        for i in range(n, min(n + 3, z.size)):
            z[i] = np.uint32(0)
        codes[k] = _put(z, n, bits, streams, at)


@inner_uncounted
def _divided(scratch: Array, height: Int, width: Int) -> tuple[Array, Array, Array]:
    """Returns three planes, four rows, and a piece, uint32, of `scratch`."""
    end = 3 * height * width
    planes = scratch[:end].reshape((3, height, width))
    return planes, scratch[end : end + 4 * width].reshape((4, width)), scratch[end + 4 * width :].view(np.uint32)


@uncounted
def encode(data: Array, codes: Array, gains: Array, streams: Array, at: Array, scratch: Array, sums: Array) -> None:
    """`data` int32 (planes, h, w): its codes (1 + planes * h * pieces,), its gains int16 (planes - 1, 2,
    squares), its pieces into the streams.  `scratch`, int32 (3 h w + 4 w + 35,), and `sums` are written to."""
    planes, height, width = data.shape
    pieces, across = (width + PIECE_WIDTH - 1) // PIECE_WIDTH, (width + SQUARE_SIDE - 1) // SQUARE_SIDE
    e, lines, z = _divided(scratch, height, width)
    line, first, second, kind = lines[0], lines[1], lines[2], _kind(data, sums)
    codes[0] = kind
    for number in range(planes):
        # Alpha's differences stay in e[0]; the others take turns.
        own, before = e[0 if number == 0 else 1 + number % 2], e[0 if number < 2 else 1 + (number - 1) % 2]
        there = _differences(data[_plane(number)], kind, own)
        start = 1 + number * height * pieces
        if not there:
            codes[start : start + height * pieces] = 0
            if number:
                gains[number - 1] = 0
            continue
        for y in range(height):
            row = own[y]
            if number:
                if y % SQUARE_SIDE == 0:
                    here = y // SQUARE_SIDE * across
                    for k in range(across):
                        one, other = _gain_of(own, e[0], before, y, SQUARE_SIDE * k)
                        gains[number - 1, 0, here + k], gains[number - 1, 1, here + k] = one, other
                    _spread(gains[number - 1, 0], here, across, first)
                    _spread(gains[number - 1, 1], here, across, second)
                _add_given(e[0][y], before[y], first, second, np.int32(-1), row, line)
                row = line
            _put_row(row, z, codes[start + y * pieces : start + (y + 1) * pieces], streams, at)


@short
def lengths_of(codes: np.ndarray, height: Int, width: Int, lengths: np.ndarray) -> bool:
    """Adds what a tile takes of each stream to `lengths` (STREAMS,); False if a code is unknown."""
    pieces = (width + PIECE_WIDTH - 1) // PIECE_WIDTH
    if codes[0] >= DIFFERENCES:
        return False
    for k in range(codes.size - 1):
        code = codes[1 + k]
        if code >= CODES:
            return False
        n = min(PIECE_WIDTH, width - PIECE_WIDTH * (k % pieces))
        if code == 1:
            lengths[0] += (n + 3) // 4
        elif code == 2:
            lengths[1] += (n + 1) // 2
        elif code == 3:
            lengths[2] += n
        elif code > 3:
            for b in range(2 if code == 4 else 4):
                lengths[3 + b] += n
    return True


@inner_uncounted
def take(raw: np.ndarray, at: np.ndarray, code: Int, z: np.ndarray, width: Int) -> None:
    """Takes the next piece of a width into `z` uint32 (>= w + 3,)."""
    if code == 1:
        n = (width + 3) // 4
        source = raw[at[0] : at[0] + n]
        for i in range(n):
            v = np.uint32(source[i])
            z[4 * i], z[4 * i + 1] = v & np.uint32(3), (v >> np.uint32(2)) & np.uint32(3)
            z[4 * i + 2], z[4 * i + 3] = (v >> np.uint32(4)) & np.uint32(3), v >> np.uint32(6)
        at[0] += n
    elif code == 2:
        n = (width + 1) // 2
        source = raw[at[1] : at[1] + n]
        for i in range(n):
            v = np.uint32(source[i])
            z[2 * i], z[2 * i + 1] = v & np.uint32(15), v >> np.uint32(4)
        at[1] += n
    elif code == 3:
        source = raw[at[2] : at[2] + width]
        for i in range(width):
            z[i] = source[i]
        at[2] += width
    else:
        z[:] = 0
        for b in range(2 if code == 4 else 4):
            source = raw[at[3 + b] : at[3 + b] + width]
            for i in range(width):
                z[i] |= np.uint32(source[i]) << np.uint32(8 * b)
            at[3 + b] += width


@inner_uncounted
def _take_row(raw: Array, at: Array, codes: Array, z: Array, line: Array) -> None:
    """Takes the next row into `line` int32 (w,), piece by piece."""
    for k in range(codes.size):
        piece = line[PIECE_WIDTH * k : min(PIECE_WIDTH * (k + 1), line.size)]
        if codes[k] == 0:
            piece[:] = 0
            continue
        take(raw, at, codes[k], z, piece.size)
        for i in range(piece.size):
            v = np.int32(z[i] >> np.uint32(1))
            piece[i] = np.int32(v ^ np.int32(-np.int32(z[i] & np.uint32(1))))


@inner_uncounted
def _summed(row: Array, before: Array, kind: Int, out: Array) -> np.int32:
    """Writes what a row of differences, int32, makes on the row before, wrapping, into `out`; gives the bits of its
    values."""
    width, bits = row.size, np.int32(0)
    if kind == 1 or kind == 3:
        total = np.int32(0)
        for i in range(width):
            total = np.int32(total + row[i])
            out[i] = total
    else:
        for i in range(width):
            out[i] = row[i]
    if kind >= 2:
        for i in range(width):
            out[i] += before[i]
    for i in range(width):
        v = np.int32(out[i])
        bits |= v ^ (v >> np.int32(31))
    return bits


@uncounted
def decode(raw: Array, codes: Array, gains: Array, at: Array, out: Array, scratch: Array) -> np.int32:
    """Returns the inverse of `encode`, `at` (STREAMS,) being where in `raw` the next piece of each width lies; gives
    the bits of all |value|."""
    planes, height, width = out.shape
    pieces, across, kind = (width + PIECE_WIDTH - 1) // PIECE_WIDTH, (width + SQUARE_SIDE - 1) // SQUARE_SIDE, codes[0]
    e, lines, z = _divided(scratch, height, width)
    first, second, largest, given = lines[1], lines[2], np.int32(0), np.int32(0)
    for number in range(planes):
        own, before = e[0 if number == 0 else 1 + number % 2], e[0 if number < 2 else 1 + (number - 1) % 2]
        start, plane = 1 + number * height * pieces, out[_plane(number)]
        for y in range(height):
            row = own[y]
            _take_row(raw, at, codes[start + y * pieces : start + (y + 1) * pieces], z, row)
            if number:
                if y % SQUARE_SIDE == 0:
                    here = y // SQUARE_SIDE * across
                    given = _spread(gains[number - 1, 0], here, across, first)
                    given |= _spread(gains[number - 1, 1], here, across, second)
                if given:
                    _add_given(e[0][y], before[y], first, second, np.int32(1), row, row)
            largest |= _summed(row, plane[max(y - 1, 0)], kind if y else kind & 1, plane[y])
    return largest
