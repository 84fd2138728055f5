"""Washes of two pigments that run into each other while wet, each settling in its own way; their rims come and go.

After Curtis et al. 1997 in kind, as `watercolour`: here the rim is dark where it dried first and
pale where it stayed damp.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from ground import Ground, smooth, stain
from watercolour import Pigment, carry, paper, settled


@dataclass(frozen=True)
class Mixture:
    """`second` is charged into `first` to about `part`, more or less by `spread`; `lost`: how much of the rim fades,
    over `fade` pixels; `cloud`: how unevenly the water lies, in waves of up to `longest` pixels; `ragged`: how the
    paper breaks the rim; `dark`: the most pigment that gathers there.
    """

    first: Pigment
    second: Pigment
    part: float = 0.4
    spread: float = 0.2
    lost: float = 0.35
    fade: float = 11.0
    cloud: float = 0.12
    longest: float = 60.0
    ragged: float = 0.5
    dark: float = 2.8


def charged(ground: Ground, mixture: Mixture) -> tuple[np.ndarray, np.ndarray]:
    """The wash as straight colour (n, n, 3) and alpha (n, n)."""
    relief = paper(ground)
    edge = ground.depth - 2.4 + 0.8 * ground.noise(33, 30.0, 7.0) + 0.3 * ground.noise(34, 5.0, 1.5)
    edge -= mixture.ragged * np.clip(relief, -0.5, 3.0) * (1.0 - smooth(0.0, 9.0, ground.depth))
    wet = edge > 0.0
    water = np.exp(mixture.cloud * ground.noise(35, mixture.longest, 16.0, 1.5))
    pull = ground.blurred(wet.astype(float), 4.2) + 0.006 * ground.noise(37, 24.0, 8.0)
    dried = carry(water * wet, wet, pull, 70)
    dried = ground.blurred(dried, 0.9) / np.maximum(ground.blurred(wet.astype(float), 0.9), 0.2)
    dried = np.minimum(np.where(dried < 1.3, dried, 1.3 + 0.8 * (dried - 1.3)), mixture.dark)
    damp = smooth(-0.45, 0.45, ground.noise(36, 46.0, 18.0, 1.2) + 2.5 * (mixture.lost - 0.5))
    reach = mixture.fade * (1.0 + 0.3 * ground.noise(38, 20.0, 5.0))
    lain = dried + damp * (water * (0.12 + 0.88 * smooth(0.0, np.maximum(reach, 3.0), ground.depth)) - dried)
    share = np.clip(mixture.part + mixture.spread * ground.noise(39, mixture.longest, 14.0, 1.5), 0.0, 1.0)
    soft = smooth(-0.3, 0.5, edge) * (1.0 - damp) + smooth(-0.5, 3.0, edge) * damp
    optical = np.zeros((*lain.shape, 3))
    for pigment, part in ((mixture.first, 1.0 - share), (mixture.second, share)):
        density = pigment.load * part * lain * settled(ground, relief, pigment.grain) * soft
        optical += density[..., None] * np.array(pigment.absorbed)
    return stain(np.ones_like(lain), optical)


LEMON = Pigment((0.16, 0.20, 0.98), 0.55, 0.04)
SAP = Pigment((0.80, 0.52, 1.30), 0.62, 0.06)
EARTH = Pigment((0.62, 0.80, 1.30), 0.66, 0.09)
FOREST = Pigment((1.40, 0.98, 1.50), 0.86, 0.08)
NIGHT = Pigment((1.55, 1.20, 1.10), 0.88, 0.12)
SKY_BLUE = Pigment((0.90, 0.50, 0.24), 0.58, 0.08)
HAZE = Pigment((0.55, 0.44, 0.26), 0.52, 0.05)
BARK = Pigment((0.55, 0.90, 1.30), 0.85, 0.10)
SEPIA = Pigment((1.15, 1.22, 1.25), 0.90, 0.13)
VIOLET = Pigment((0.86, 0.92, 0.55), 0.58, 0.09)
SLATE = Pigment((1.10, 0.85, 0.58), 0.62, 0.12)
ROSE = Pigment((0.10, 0.75, 0.50), 0.70, 0.04)
BLUSH = Pigment((0.04, 0.38, 0.32), 0.65, 0.03)

EXAMPLES = {
    "wash-sky": lambda: (g := Ground(380, 71), *charged(g, Mixture(SKY_BLUE, HAZE, 0.4, 0.22, 0.75, 24.0, 0.22, 70.0))),
    "wash-spring-green": lambda: (g := Ground(360, 72), *charged(g, Mixture(SAP, LEMON, 0.6, 0.22, lost=0.3))),
    "wash-olive": lambda: (g := Ground(360, 73), *charged(g, Mixture(SAP, EARTH, 0.5, 0.24, lost=0.25))),
    "wash-deep-green": lambda: (g := Ground(360, 74), *charged(g, Mixture(FOREST, NIGHT, 0.4, 0.15, lost=0.3))),
    "wash-bark": lambda: (
        g := Ground(340, 75),
        *charged(g, Mixture(BARK, SEPIA, 0.45, 0.2, 0.35, 7.0, 0.14, 50.0, 0.6, 1.9)),
    ),
    "wash-violet": lambda: (g := Ground(360, 76), *charged(g, Mixture(VIOLET, SLATE, 0.45, 0.25, 0.4, 14.0))),
    "wash-blossom": lambda: (g := Ground(320, 77), *charged(g, Mixture(ROSE, BLUSH, 0.5, 0.3, 0.3, 9.0))),
}
