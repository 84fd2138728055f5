"""Written textures: ten lines of two noises of six octaves, a sample of which may take 100 ns; from a text that nobody
has seen to a picture of 128 x 128, which may take 100 ms."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from bench import Figure
from bench.clock import best
from engine.numeric.address import Rect
from engine.texture.expression.defined import expression
from engine.texture.expression.examined import line_look, line_planes

REPEATS = 15
SAMPLE, KEYSTROKE = 100.0, 0.1  # ns, s
SIDE = 256
TEXT = """deep = slider(0.6, 0, 1)
rust = pick(#a04020)
hills = fbm(x, y, 6)
grain = fbm(x*3, y*3, 6, 0.6, 2, 1)
mossy = smoothstep(0.45, 0.6, hills)
stone = mix(#405060, #a0a090, grain)
worn = mix(stone, rust, mossy*deep)
edge = 0.5 + 0.5*sin(hills*20)
shade = 0.8 + 0.2*edge
ramp(hills, 0.3, #203040, 0.6, #e0d0b0)*0.2 + worn*shade
"""
SUM = TEXT.rsplit("ramp", 1)[0] + "hills*0.7 + grain*0.3 + x*0.01"


def measure(small: bool = False) -> Iterator[Figure]:
    repeats = 1 if small else REPEATS
    for name, text, level in (("near", TEXT, 6), ("its sum, near", SUM, 6), ("its sum, at its own size", SUM, 0)):
        yield _sample(name, text, level, repeats)
    yield _keystroke(repeats)


def _sample(name: str, text: str, level: int, repeats: int) -> Figure:
    made = expression({"text": text}, 0)
    rect = Rect.at(0, 0, SIDE, SIDE)
    last = len(text.splitlines()) - 1
    [taken] = best(repeats, lambda: line_planes(made, last, level, rect))  # what `means` gives is kept
    each = taken / rect.area * 1e9
    note = f"{line_look(made, last, level).samples or 'one to sixteen'} samples a pixel"
    return Figure(f"a pixel of ten lines, {name}", each, "ns", "100 ns", each / SAMPLE, 1.0, note=note)


def _keystroke(repeats: int) -> Figure:
    count = iter(range(1 << 30))

    def own() -> np.ndarray:
        made = expression({"text": TEXT.replace("0.8 +", f"0.8 + 0.001*{next(count)} +")}, 0)
        return made.means(0, Rect.at(0, 0, 128, 128))

    [taken] = best(repeats, own)
    return Figure("from a text to 128 x 128", taken * 1e3, "ms", "100 ms", taken / KEYSTROKE, 1.0)
