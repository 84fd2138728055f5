"""What corrections make of control channels: how far apart they are, and where an example goes on, turned."""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import Int, inlined, inner_uncounted
from engine.texture.example.exemplar import COUNTS
from engine.texture.example.region_window import Example, Rules, Window

_FREE = 16  # steps, of 255, that are no matter: pixels that are just alike are few, and would come again and again
_TURNED = 192  # of 256 parts of the angle between two copies, by which a pixel is turned otherwise than is wanted
AT_SIDE, AT_ACROSS, AT_DOWN, AT_PADDING, AT_COPIES, AT_TURNS = range(6)  # of `Control.turns`


@inlined
def told_apart(window: Window, y: Int, x: Int, example: Example, name: Int, rules: Rules) -> Int:
    """Returns the energy between what channels tell of a pixel and of one of the example."""
    e = np.int32(0)
    for c in range(rules.told.size):
        weight = rules.told[c]
        apart = np.int32(window.told[c, y, x]) - np.int32(example.told[c, name >> 16, name & 0xFFFF])
        if weight < 0:  # goes round
            apart, weight = ((apart + 128) & 255) - 128, -weight
        else:
            apart = np.int32(max(np.int32(0), abs(apart) - _FREE))
        e += np.int32(weight * apart * apart)
    return e


@inlined
def way_of(window: Window, y: Int, x: Int, example: Example) -> Int:
    """Tells which of the example's pixels run as is wanted of a pixel: where their list begins in `starts`."""
    if example.turns.size == 0:
        return np.int64(0)
    copies = example.turns[AT_COPIES]
    return np.int64(((window.told[0, y, x] * copies + 128) >> 8) % copies * (COUNTS + 1))


@inner_uncounted
def turned_source(example: Example, name: Int, wanted: Int) -> Int:
    """Returns the same place of the example in the copy in which it is turned as is `wanted`; -1 if that is where it
    is, or lies outside."""
    turns, row, column = example.turns, name >> 16, name & 0xFFFF
    copies = turns[AT_COPIES]
    apart = ((np.int32(wanted) - np.int32(example.told[0, row, column]) + 128) & 255) - 128
    if abs(apart * copies) < _TURNED:
        return np.int32(-1)
    turn = (((apart * copies + 128) >> 8) + copies) % copies
    side = turns[AT_SIDE]
    down, across = (row - turns[AT_PADDING]) // side, (column - turns[AT_PADDING]) // side
    if down < 0 or across < 0 or down >= turns[AT_DOWN] or across >= turns[AT_ACROSS]:
        return np.int32(-1)
    copy = down * turns[AT_ACROSS] + across
    y = 2 * (row - turns[AT_PADDING] - down * side) + 1 - side
    x = 2 * (column - turns[AT_PADDING] - across * side) + 1 - side
    other = (copy + turn) % copies
    cosine, sine = turns[AT_TURNS + 2 * turn], turns[AT_TURNS + 2 * turn + 1]
    y, x = (sine * x + cosine * y) >> 15, (cosine * x - sine * y) >> 15
    y += turns[AT_PADDING] + (other // turns[AT_ACROSS]) * side + side // 2
    x += turns[AT_PADDING] + (other % turns[AT_ACROSS]) * side + side // 2
    if y < 0 or x < 0 or y >= example.region.shape[0] or x >= example.region.shape[1] or example.region[y, x] == 0:
        return np.int32(-1)
    return np.int32(y << 16 | x)
