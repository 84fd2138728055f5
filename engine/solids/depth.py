"""Which triangle is nearest at each place of a picture, a z-buffer; and what light comes past it."""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import kernel


@kernel
def draw_triangles(
    corners: np.ndarray, faces: np.ndarray, first: int, nearest: np.ndarray, names: np.ndarray, top: int
) -> None:
    """Draws triangles into rows `top`... of a picture.

    `corners` (V, 3): x and y in pixels, and what is the greater the nearer, linear across a triangle on the picture;
    `nearest`: float32 (h, w), the greatest so far; `names`: int32 (h, w), `first` + the triangle's index there.
    """
    height, width = nearest.shape
    for f in range(faces.shape[0]):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        ax, ay, bx, by = corners[a, 0], corners[a, 1] - top, corners[b, 0], corners[b, 1] - top
        cx, cy = corners[c, 0], corners[c, 1] - top
        area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
        if area == 0.0 or not np.isfinite(area):
            continue
        y0 = max(0, int(np.ceil(min(ay, by, cy) - 0.5)))
        y1 = min(height - 1, int(np.floor(max(ay, by, cy) - 0.5)))
        if y0 > y1:
            continue
        x0 = max(0, int(np.ceil(min(ax, bx, cx) - 0.5)))
        x1 = min(width - 1, int(np.floor(max(ax, bx, cx) - 0.5)))
        for y in range(y0, y1 + 1):
            for x in range(x0, x1 + 1):
                px, py = x + 0.5, y + 0.5
                u = ((px - ax) * (cy - ay) - (cx - ax) * (py - ay)) / area
                v = ((bx - ax) * (py - ay) - (px - ax) * (by - ay)) / area
                if u < 0.0 or v < 0.0 or u + v > 1.0:
                    continue
                depth = corners[a, 2] + u * (corners[b, 2] - corners[a, 2]) + v * (corners[c, 2] - corners[a, 2])
                if depth > nearest[y, x]:
                    nearest[y, x] = depth
                    names[y, x] = first + f


@kernel
def let_through(points: np.ndarray, normals: np.ndarray, views: np.ndarray, maps: np.ndarray, out: np.ndarray) -> None:
    """Adds the light of many directions that reaches points (N, 3): `out` (N, 3).

    Each of `views` (K, 15): the axes across, down and towards the light; where its map begins and the pixels of a unit;
    the light's colour; how far a point is lifted.  `maps`: float32 (K, n, n), the height of what is nearest to
    each light.  Between four pixels the answer is mixed.
    """
    side = maps.shape[1]
    for i in range(points.shape[0]):
        nx, ny, nz = normals[i, 0], normals[i, 1], normals[i, 2]
        for k in range(views.shape[0]):
            view = views[k]
            falls = nx * view[6] + ny * view[7] + nz * view[8]
            if falls <= 0.0:
                continue
            lift = view[14]
            x, y, z = points[i, 0] + lift * nx, points[i, 1] + lift * ny, points[i, 2] + lift * nz
            across = (x * view[0] + y * view[1] + z * view[2] - view[9]) * view[10] - 0.5
            down = (x * view[3] + y * view[4] + z * view[5] - view[9]) * view[10] - 0.5
            high = x * view[6] + y * view[7] + z * view[8] + 0.5 * lift
            px, py = int(np.floor(across)), int(np.floor(down))
            share = 1.0
            if 0 <= px < side - 1 and 0 <= py < side - 1:
                fx, fy = across - px, down - py
                share = (1.0 - fy) * (
                    (1.0 - fx) * (maps[k, py, px] <= high) + fx * (maps[k, py, px + 1] <= high)
                ) + fy * ((1.0 - fx) * (maps[k, py + 1, px] <= high) + fx * (maps[k, py + 1, px + 1] <= high))
            for channel in range(3):
                out[i, channel] += share * falls * view[11 + channel]
