"""Materials: solids that are functions of the place, with few parameters each.

Heeger & Bergen's section 6 names the ways, after Perlin, Peachey and Lewis: ramps of perturbed sines (marble), rings
around an axis (wood), band-passed noise (granite), a signal of one dimension along a path through the solid (agate).
All repeat after one unit along each axis, without a seam, and have detail at every scale.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from engine.numeric import elementary
from engine.solids.material_sliders import Values
from engine.solids.solid_noise import Octaves, noise_at

Stops = tuple[tuple[float, str], ...]
_TURN = 2.0 * 3.141592653589793


@dataclass(frozen=True, slots=True)
class Seen:
    """Where a material is asked for: `points` (N, 3) of x, y, z in units; the `seed`; the `finest` length of interest,
    in units."""

    points: np.ndarray
    seed: int
    finest: float

    def noise(self, cells: int | tuple[int, int, int], which: int, gain: float = 0.5, most: int = 24) -> np.ndarray:
        """Returns noise (N,) of octaves from `cells` on; `which` tells a material's noises apart."""
        along = (cells,) * 3 if isinstance(cells, int) else cells
        return noise_at(self.points, Octaves(along, gain, most), 16 * self.seed + which, self.finest)

    def at(self, points: np.ndarray) -> Seen:
        """Returns the same at other places."""
        return Seen(points, self.seed, self.finest)


def colour_ramp(at: np.ndarray, stops: Stops) -> np.ndarray:
    """Colours (N, 3) of a ramp through `stops` of place and "#rrggbb"."""
    places = [place for place, _ in stops]
    colours = np.array([[int(text[i : i + 2], 16) / 255.0 for i in (1, 3, 5)] for _, text in stops])
    return np.stack([np.interp(at, places, colours[:, channel]) for channel in range(3)], axis=-1)


def _wave(turns: np.ndarray) -> np.ndarray:
    """The sine of a number of turns."""
    return elementary.mapped(elementary.sin, _TURN * turns)


def _between(low: float, high: float, values: np.ndarray) -> np.ndarray:
    """0 below `low`, 1 above `high`, smooth between."""
    t = np.clip((values - low) / (high - low), 0.0, 1.0)
    out: np.ndarray = t * t * (3.0 - 2.0 * t)
    return out


def _mixed(below: np.ndarray, above: np.ndarray | tuple[float, float, float], share: np.ndarray) -> np.ndarray:
    out: np.ndarray = below + (np.asarray(above) - below) * share[:, None]
    return out


_MARBLE: Stops = ((0.0, "#f4f1ea"), (0.45, "#e4e2de"), (0.75, "#b9bcc0"), (1.0, "#8e959d"))
_VERDE: Stops = ((0.0, "#123026"), (0.45, "#24503f"), (0.75, "#3f7660"), (1.0, "#8db9a2"))


def _marble(seen: Seen, values: Values) -> np.ndarray:
    """Veins are where sines of a place that noise has moved pass zero: broad soft ones, then thin dark ones."""
    x, y, z = seen.points.T
    veins, moved = 0.5 * values["veins"], values["turbulence"]
    broad = seen.noise(2, 0, 0.55)
    fine = seen.noise(3, 1, 0.6)
    soft = 1.0 - np.abs(_wave(veins * (x + y) + moved * broad))
    sharp = 1.0 - np.abs(_wave(veins * (x + y - z) + moved * (0.6 * broad + fine)))
    weak = _between(-0.35, 0.45, seen.noise(3, 2, 0.5, 3))  # veins come and go
    cloud = 0.32 + 0.34 * broad + 0.55 * elementary.powers(soft, 3.0) * weak
    line = elementary.powers(sharp, values["sharpness"]) * (0.25 + 0.75 * weak)
    pale = colour_ramp(cloud, _MARBLE)
    pale = _mixed(pale, (0.30, 0.31, 0.33), 0.85 * line)
    gold = elementary.powers(sharp, 2.2 * values["sharpness"]) * _between(0.0, 0.5, fine) * values["gold"]
    pale = _mixed(pale, (0.63, 0.46, 0.25), 0.9 * gold)
    dark = _mixed(colour_ramp(cloud, _VERDE), (0.86, 0.93, 0.88), 0.9 * line)
    return _mixed(pale, dark, np.full(len(x), values["green"]))


_WOOD: Stops = ((0.0, "#98704f"), (0.45, "#866044"), (0.8, "#66432d"), (0.94, "#4a2d1d"), (1.0, "#8a6346"))


def _wood(seen: Seen, values: Values) -> np.ndarray:
    """Rings around an axis along z, which noise bends; each grows darker towards its end.  Fibres run along."""
    x, y, _ = seen.points.T
    bent = values["bend"]
    slow = seen.noise((2, 2, 1), 0, 0.45, 4)
    other = seen.noise((2, 2, 1), 1, 0.45, 4)
    across, along = _wave(0.5 * (x + 0.31) + 0.02 * bent * slow), _wave(0.5 * (y + 0.17) + 0.02 * bent * other)
    far = np.sqrt(across * across + along * along) + 0.012 * bent * seen.noise((5, 5, 1), 2, 0.5, 4)
    rings = values["rings"] * far
    year = np.floor(rings)
    ring = rings - year
    late = year * 0.61803398875 - np.floor(year * 0.61803398875)  # no two years are alike
    fibre = seen.noise((48, 48, 3), 3, 0.6, 7)
    pore = seen.noise((160, 160, 7), 4, 0.5, 6)
    dark = ring * (ring + (ring * ring - ring) * late)
    colour = colour_ramp(dark, _WOOD) * (1.0 + values["fibres"] * (0.10 * fibre + 0.10 * slow))[:, None]
    holes = _between(0.24, 0.6, pore) * (0.3 + 0.7 * dark) * values["fibres"]
    out: np.ndarray = np.clip(_mixed(colour, (0.20, 0.12, 0.08), 0.6 * holes), 0.0, 1.0)
    return out


def _granite(seen: Seen, values: Values) -> np.ndarray:
    """Three minerals, each where its own band-passed noise is high, and each with a grain of its own."""
    grains = int(values["grains"])
    edge = 0.05
    first = seen.noise(grains, 0, 0.55, 5)
    second = seen.noise(grains, 1, 0.55, 5)
    mica = seen.noise(2 * grains, 2, 0.6, 5)
    grain = seen.noise(4 * grains, 3, 0.65, 8)
    cloud = seen.noise(3, 4, 0.5, 3)
    pink = colour_ramp(0.5 + 0.6 * grain + 0.3 * cloud, ((0.0, "#9a6a58"), (0.5, "#c39783"), (1.0, "#e2c4b2")))
    quartz = colour_ramp(0.5 + 0.7 * grain, ((0.0, "#7d7a78"), (0.5, "#a9a5a1"), (1.0, "#d6d2cc")))
    white = colour_ramp(0.5 + 0.5 * grain, ((0.0, "#cfc6ba"), (0.5, "#e6dfd4"), (1.0, "#f6f1ea")))
    black = colour_ramp(0.5 + 0.7 * grain, ((0.0, "#141316"), (0.6, "#2c2a2c"), (1.0, "#5a5552")))
    colour = _mixed(quartz, pink, _between(-edge, edge, first - 0.25 + 0.5 * values["pink"]))
    colour = _mixed(colour, white, _between(-edge, edge, second - 0.16))
    return _mixed(colour, black, _between(-edge, edge, mica - 0.42 + 0.5 * values["mica"]))


_AGATE: Stops = (
    *((0.0, "#2a1512"), (0.14, "#6a2a18"), (0.28, "#b4552a"), (0.4, "#e2a35c"), (0.5, "#f5e6cf")),
    *((0.6, "#d9cfc4"), (0.7, "#a98d86"), (0.8, "#7a4a44"), (0.9, "#c47a45"), (1.0, "#f0d2a4")),
)


def _agate(seen: Seen, values: Values) -> np.ndarray:
    """Bands lie at equal depths of a hollow that noise has shaped; how dark each is tells a signal of one dimension."""
    hollow = seen.noise(2, 0, 0.42, 4) + 0.05 * seen.noise(9, 1, 0.55, 6)
    depth = values["bands"] * (0.5 + 0.42 * hollow)
    still = np.zeros_like(depth)
    signal = seen.at(np.stack([depth / 64.0, still, still], axis=-1))
    signal = Seen(signal.points, seen.seed, seen.finest * values["bands"] / 64.0)
    band = signal.noise((64, 1, 1), 2, 0.75, 6) + 0.6 * signal.noise((12, 1, 1), 3, 0.5, 2)
    colour = colour_ramp(np.clip(0.5 + 0.62 * band, 0.0, 1.0), _AGATE)
    line = elementary.powers(1.0 - np.abs(_wave(1.5 * depth)), 9.0)
    colour = _mixed(colour, (0.97, 0.93, 0.86), 0.35 * line)
    crystal = _between(0.62, 0.74, hollow)  # the middle is filled with quartz
    facets = np.abs(seen.noise(22, 5, 0.6, 7))
    return _mixed(colour, colour_ramp(facets, ((0.0, "#f7f2f4"), (0.25, "#d8cfdb"), (0.7, "#8d7f9e"))), crystal)


_Colours = Callable[[Seen, Values], np.ndarray]
_BENT = 0.35  # units: how far noise moves places at most, about
_LAYERS, _DARKEST = 9, 0.8


def _worked(colours: _Colours, other: _Colours, share: str, of_other: Values, bright: float) -> _Colours:
    """A material that can be bent as a whole, and multiplied by another, made so `bright`, and by a signal along z."""

    def made(seen: Seen, values: Values) -> np.ndarray:
        there = seen
        if values["warp"] > 0.0:
            moved = np.stack([seen.noise(2, 12 + axis, 0.5, 5) for axis in range(3)], axis=-1)
            there = seen.at(seen.points + _BENT * values["warp"] * moved)
        out = colours(there, values)
        if values[share] > 0.0:
            glaze = np.clip(bright * other(seen, of_other), 0.0, 1.0)
            out = out * (1.0 + values[share] * (glaze - 1.0))
        if values["strata"] > 0.0:
            still = np.full_like(there.points, 0.37)
            still[:, 2] = there.points[:, 2]
            signal = _between(-0.35, 0.5, seen.at(still).noise((1, 1, _LAYERS), 15, 0.6, 8))
            out = out * (1.0 - _DARKEST * values["strata"] * signal)[:, None]
        return out

    return made


_MARBLED = {"veins": 3.0, "turbulence": 1.2, "sharpness": 4.0, "gold": 0.0, "green": 0.0}
_GRAINED = {"grains": 28.0, "pink": 0.5, "mica": 0.5}
COLOURS: dict[str, _Colours] = {
    "marble": _worked(_marble, _granite, "speckle", _GRAINED, 1.6),
    "wood": _worked(_wood, _marble, "cloud", _MARBLED, 1.05),
    "granite": _worked(_granite, _marble, "cloud", _MARBLED, 1.05),
    "agate": _worked(_agate, _granite, "speckle", _GRAINED, 1.6),
}
"""Of what is seen and the values of all sliders: float64 (N, 3) in 0..1, as a screen shows them."""
