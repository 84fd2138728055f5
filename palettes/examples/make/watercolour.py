"""Five strokes of watercolour: pigment carried to the rim by drying water, settling in the paper's hollows.

After Curtis et al. 1997 in kind: a wet region, a flow outwards that the drying rim feeds, pigment that cannot leave it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from ground import FINE, Ground, numbers, smooth, stain
from skimage.graph import MCP_Geometric


@dataclass(frozen=True)
class Pigment:
    """`absorbed`: of red, green and blue at density 1; `load`: density laid; `grain`: how much settles in hollows."""

    absorbed: tuple[float, float, float]
    load: float
    grain: float
    carried: float = 1.0


def paper(ground: Ground) -> np.ndarray:
    """The relief of cold-pressed paper: hollows negative, deviation 1."""
    return 0.75 * ground.noise(1, 14.0, 5.0, 1.2) + 0.65 * ground.noise(2, 6.0, 2.6, 1.0)


def carry(pigment: np.ndarray, wet: np.ndarray, pull: np.ndarray, steps: int) -> np.ndarray:
    """Pigment moved down the slope of `pull` (at most half a pixel a step), never across the rim of what is wet."""
    faces = [wet[1:] & wet[:-1], wet[:, 1:] & wet[:, :-1]]
    speeds = [-(pull[1:] - pull[:-1]) * faces[0], -(pull[:, 1:] - pull[:, :-1]) * faces[1]]
    top = max(np.abs(s).max() for s in speeds)
    down, across = (s / top * 0.24 for s in speeds)
    for _ in range(steps):
        moved_down = np.where(down > 0, pigment[:-1], pigment[1:]) * down
        moved_across = np.where(across > 0, pigment[:, :-1], pigment[:, 1:]) * across
        spread_down = (pigment[:-1] - pigment[1:]) * 0.02 * faces[0]
        spread_across = (pigment[:, :-1] - pigment[:, 1:]) * 0.02 * faces[1]
        pigment = pigment.copy()
        pigment[:-1] -= moved_down + spread_down
        pigment[1:] += moved_down + spread_down
        pigment[:, :-1] -= moved_across + spread_across
        pigment[:, 1:] += moved_across + spread_across
    return pigment


def wash(ground: Ground, pigment: Pigment, blooms: int = 0, dry: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """A wash with a dark rim; `blooms`: backruns from late drops, along a side; `dry`: how grain breaks the rim."""
    relief = paper(ground)
    edge = ground.depth - 2.2 + 0.55 * ground.noise(3, 26.0, 7.0) + 0.3 * ground.noise(4, 5.0, 1.5)
    edge -= dry * np.clip(relief, -0.5, 3.0) * (1.0 - smooth(0.0, 9.0, ground.depth))
    wet = edge > 0.0
    laid = 1.0 + 0.15 * ground.noise(5, 50.0, 12.0, 1.3)
    pull = ground.blurred(wet.astype(float), 4.2) + 0.006 * ground.noise(7, 24.0, 8.0)
    carried = carry(laid * wet, wet, pull, int(95 * pigment.carried))
    if blooms:
        carried = _bloomed(ground, carried, wet, blooms)
    carried = ground.blurred(carried, 0.9) / np.maximum(ground.blurred(wet.astype(float), 0.9), 0.2)
    carried = np.where(carried < 1.3, carried, 1.3 + 0.85 * (carried - 1.3))
    density = pigment.load * np.minimum(carried, 3.6) * settled(ground, relief, pigment.grain)
    return stain(density * smooth(-0.3, 0.5, edge), pigment.absorbed)


def settled(ground: Ground, relief: np.ndarray, grain: float) -> np.ndarray:
    """How much pigment lies where: more in the paper's hollows, in small clots; about 1 on average."""
    hollow = np.clip(-relief, -1.2, 2.2) + 0.35 * ground.noise(8, 3.0, 1.8, 0.8)
    return np.exp(grain * hollow - 0.5 * grain * grain)


def _bloomed(ground: Ground, pigment: np.ndarray, wet: np.ndarray, count: int) -> np.ndarray:
    """Drops of clean water: pale inside, a dark crinkled front where they stopped."""
    places = ground.dots(11, ground.size / (count + 0.4), 0.7)
    crinkle = 1.0 + 0.24 * ground.noise(12, 40.0, 6.0, 1.4) + 0.05 * ground.noise(13, 5.0, 2.0)
    for k, (x, y) in enumerate(places):
        radius = 8.0 + 26.0 * numbers(ground.seed + 77 + k, 1)[0] ** 1.5
        reach = np.hypot(ground.x - x, ground.y - y) * crinkle - radius
        front = np.exp(-((reach / 1.3) ** 2)) + 0.25 * np.exp(-np.clip(reach, 0.0, 99.0) / 4.0) * (reach > 0.0)
        pale = (0.35 + 0.65 * smooth(-1.1 * radius, -1.0, reach)) * (1.0 - smooth(-1.0, 1.0, reach))
        pigment = pigment * (1.0 - 0.32 * pale) + 0.9 * front * wet
    return pigment


def feathered(ground: Ground, pigment: Pigment, reach: float = 17.0) -> tuple[np.ndarray, np.ndarray]:
    """Wet in wet: pigment ran out into damp paper, finger by finger, each along the easiest way."""
    relief = paper(ground)
    ease = np.exp(0.95 * ground.noise(21, 12.0, 3.0, 1.0) + 0.2 * relief)
    start = np.argwhere((ground.depth > reach) & (ground.depth < reach + 0.7))
    time, _ = MCP_Geometric(1.0 / ease).find_costs(start)
    late = np.where(ground.depth > reach, 0.0, time / FINE) / (0.55 * reach)
    late += 0.12 * ground.noise(22, 30.0, 8.0)
    front = np.clip(1.15 - 1.25 * late, 0.0, 1.0)
    fade = smooth(0.5, 6.0, ground.depth)
    cloudy = 1.0 + 0.13 * ground.noise(23, 36.0, 8.0)
    tips = 0.35 * np.exp(-(((front - 0.15) / 0.10) ** 2)) * (late > 0.2)
    density = pigment.load * (front**1.5 + tips) * fade * np.clip(cloudy, 0.3, 2.0)
    return stain(density * settled(ground, relief, pigment.grain), pigment.absorbed)


INDIGO = Pigment((1.75, 1.05, 0.48), 0.70, 0.21)
SAP_GREEN = Pigment((1.05, 0.42, 1.7), 0.66, 0.05)
SIENNA = Pigment((0.28, 0.92, 1.65), 0.70, 0.15)
ROSE = Pigment((0.07, 1.25, 0.52), 0.85, 0.06)
OCHRE = Pigment((0.06, 0.33, 1.35), 0.80, 0.10)

EXAMPLES = {
    "wash-indigo": lambda: (g := Ground(300, 11), *wash(g, INDIGO)),
    "wash-sap-green": lambda: (g := Ground(300, 12), *wash(g, SAP_GREEN, blooms=4)),
    "wash-burnt-sienna": lambda: (g := Ground(300, 13), *wash(g, SIENNA, dry=2.2)),
    "wash-rose": lambda: (g := Ground(300, 14), *feathered(g, ROSE)),
    "wash-ochre": lambda: (g := Ground(300, 15), *feathered(g, OCHRE, 13.0)),
}
