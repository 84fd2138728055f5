"""Textures to match, made by the program, and photographs of skimage: float32 (C, h, w) in 0..1."""

import numpy as np
import skimage.data

from engine.numeric.address import Rect
from engine.texture.table import instance


def rock(size, period, roughness, seed, stretch=(1, 1)):
    """0..1 (h, w); `stretch`: how many times longer features are down and across."""
    height, width = (-(-n // s) for n, s in zip(size, stretch, strict=True))
    made = instance("rock", {"period": period, "roughness": roughness, "seed": seed}, 0, 0)
    found = 0.5 + 0.5 * made.appearance(0, Rect.at(0, 0, width, height))[0]
    grown = np.repeat(np.repeat(found, stretch[0], axis=0), stretch[1], axis=1)
    return grown[: size[0], : size[1]]


def blend(parts, *colours):
    """Colours "rrggbb" laid over one another, the first everywhere, the others by their parts (h, w)."""
    out = None
    for part, colour in zip([np.float32(1.0), *parts], colours, strict=True):
        rgb = np.array([int(colour[i : i + 2], 16) / 255 for i in (0, 2, 4)], np.float32)[:, None, None]
        out = rgb * np.ones_like(parts[0]) if out is None else out + (rgb - out) * part
    return np.clip(out, 0.0, 1.0).astype(np.float32)


def steep(values, at, width):
    return np.clip((values - at) / width + 0.5, 0.0, 1.0)


def granite(size=(128, 128), seed=1):
    spots = [rock(size, 9, 0.6, seed + k) for k in range(3)]
    return blend([steep(spots[0], 0.55, 0.1), steep(spots[1], 0.62, 0.08), spots[2] * 0.3], *_GRANITE)


def sand(size=(128, 128), seed=2):
    return blend(
        [rock(size, 4, 0.3, seed), steep(rock(size, 3, 0.5, seed + 1), 0.7, 0.2)], "b08a5c", "e2c490", "6a4a2c"
    )


def bark(size=(128, 128), seed=3):
    long, fine = rock(size, 8, 0.4, seed, (6, 1)), rock(size, 6, 0.4, seed + 1)
    return blend([steep(0.7 * long + 0.3 * fine, 0.5, 0.3), 0.4 * fine], "3a2a20", "8a705a", "b8a890")


def moss(size=(128, 128), seed=4):
    return blend(
        [rock(size, 14, 0.4, seed), steep(rock(size, 5, 0.4, seed + 1), 0.55, 0.3)], "1e3a1a", "4f7a2a", "a8b850"
    )


def wood(size=(128, 128), seed=5):
    """Long grain, which the method cannot make (figure 8)."""
    bent = rock(size, 90, 0.9, seed, (4, 1))
    rings = 0.5 + 0.5 * np.sin(2.0 * np.pi * (np.arange(size[1]) / 14.0 + 5.0 * bent))
    return blend([rings**2, 0.3 * rock(size, 3, 0.3, seed + 1, (8, 1))], "7a4a24", "c89a60", "4a2a14")


def photograph(name, size=(128, 128), at=(0, 0)):
    """A crop of a grey photograph: gravel, grass or brick."""
    whole = getattr(skimage.data, name)()
    crop = whole[at[0] : at[0] + size[0], at[1] : at[1] + size[1]]
    return (crop[None] / 255.0).astype(np.float32)


_GRANITE = ("b89a90", "e8dcd4", "2c2a30", "604848")
STOCHASTIC = {"granite": granite, "sand": sand, "bark": bark, "moss": moss}
