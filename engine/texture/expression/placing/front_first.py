"""Things laid over a picture, the nearest first: what is behind shows where those before it leave room."""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import uncounted

_FULL = 0.9995  # of a pixel: what is behind does not show


def from_front(depth: np.ndarray, number: np.ndarray) -> np.ndarray:
    """Returns the order from the front, the greatest depth, to the back, by numbers where it is equal: that of
    `np.lexsort((number, -depth))`, of hundreds of thousands in a quarter of the time, as few lie equally deep."""
    order = np.argsort(-depth)
    alike = depth[order[1:]] == depth[order[:-1]]
    if alike.any():
        which = np.flatnonzero(np.append(alike, False) | np.append(False, alike))
        these = np.sort(order[which])
        order[which] = these[np.lexsort((number[these], -depth[these]))]
    return order


@uncounted
def lay_behind(planes: np.ndarray, boxes: np.ndarray, parts: np.ndarray, out: np.ndarray) -> None:
    """Lays pixels behind what is there: `planes` float32 (4, n), those of one box after another; `boxes` int64 (k, 4):
    first and last column and row of each; `parts` (k,): how much there is of each; `out` float32 (4, h, w)."""
    n = 0
    for k in range(boxes.shape[0]):
        for y in range(boxes[k, 1], boxes[k, 3]):
            for x in range(boxes[k, 0], boxes[k, 2]):
                room = np.float32(1.0) - out[3, y, x]
                if room > np.float32(0.0):
                    alpha = min(max(planes[3, n], np.float32(0.0)), np.float32(1.0))
                    weight = room * parts[k]
                    for c in range(3):
                        out[c, y, x] += weight * min(max(planes[c, n], np.float32(0.0)), alpha)
                    full = out[3, y, x] + weight * alpha
                    out[3, y, x] = np.float32(1.0) if full > _FULL else full
                n += 1


@uncounted
def open_boxes(boxes: np.ndarray, out: np.ndarray, there: np.ndarray) -> None:
    """Tells of boxes, int64 (k, 4), whether anything behind shows in any of their pixels: uint8 (k,)."""
    for k in range(boxes.shape[0]):
        found = False
        for y in range(boxes[k, 1], boxes[k, 3]):
            for x in range(boxes[k, 0], boxes[k, 2]):
                found = found or out[3, y, x] < np.float32(1.0)
            if found:
                break
        there[k] = np.uint8(found)
