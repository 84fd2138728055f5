"""Small recordings that together do all that a recording can: each mode, operation, texture, curve, maker, blend mode.

    python everything.py FOLDER VERSION [NAME ...]

plays them, as recordings of that version, and prints {name: hashes of the pixels that are exported, and of all values
that are stored or evaluated}.  FOLDER holds what `pictures` wrote.
"""

from __future__ import annotations

import hashlib
import io
import json
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from engine.archive import export
from engine.brush.ops import OPS
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.files.images import read_image
from engine.numeric.address import Rect
from engine.numeric.blend import BLENDS
from engine.numeric.curves import CURVES, EDGES
from engine.painting.grown import settled
from engine.painting.recording import read_from
from engine.painting.value import Painting
from engine.session.replay import replay
from engine.texture.table import KINDS

FRAME = [0, 0, 96, 72]
PLACES = ((-1, Rect.at(-8, -8, 64, 52)), (0, Rect.at(-16, -16, 128, 104)), (2, Rect.at(100, 90, 96, 96)))
DEEP = (14, Rect.at((40 << 14) + 77, (30 << 14) + 5, 64, 64))
WRITTEN = "deep = slider(0.6, 0, 1)\nfbm(x*2, y*2, 5)*deep + cells_edge(x*3, y*3)*white(x*7, y*7)*log(2 + sin(x*9))"
WRITTEN_COLOURS = (
    "a = warp(ridged(x, y, 4), noise(x, y)**1.3, exp(-abs(tan(y))))\n"
    "b = rotate(hexagons(x*3, y*3), atan2(1, 3)*57)\n"
    "over(fade(ramp(a, #000000, #c06020, #ffe0a0), b), ramp(bricks_random(x*2, y*4), #203040c0, #f0f0f080))"
)
LINE = [[8, 12, 0.3, 0, 0, 0], [40, 30, 0.9, 10, 5, 0.1], [88, 60, 0.6, 20, 0, 0.25]]
BACK = [[88, 10, 1, 0, 0, 0], [50, 40, 0.7, 0, 0, 0.1], [10, 64, 0.2, 0, 0, 0.3]]
WAVES = {"period": 13.7, "angle": 33.3, "phase": 0.21}
FORMULAS = (
    "0.3*sin(x/3.1) + 0.2*cos(y*1.7)",
    "tan(x/17) * 0.1 + atan2(y - 30.3, x - 41.7) / 4",
    "exp(-abs(x - 40)/9) - log(1 + luma*7)/5",
    "pow(pic, 1.7) - pic + 0.1*tex**0.3*noise(x/4, y/5)",
    "mix(colour, pic, smoothstep(0, 60, x)) - pic*fract(y/7.3) + d*pressure*0.1*step(0.5, level + 0.7)",
    "sqrt(luma)*clamp(mod(x, 7)/7, 0.2, 0.9) - min(pic, 1 - pic)*floor(y/5)/9 - max(pic, abs(0.3 - luma))",
)


def stroke(*points: list[float], level: int = 0, **brush: Any) -> dict[str, Any]:
    """A stroke command; with no points, along a line."""
    given = {"radius": 14.3, "hardness": 0.37, "colour": "#c06020", **brush}
    return {"do": "stroke", "level": level, "points": list(points) or LINE, "brush": given, "seed": 5}


def ink(name: str, **more: Any) -> dict[str, Any]:
    return {"texture": name, "amount": 0.83, "colour": "#f0e0a0", **more}


RAMP = [[0, "#102040"], [0.37, "#e0a03080"], [1, "#ffffff"]]
GROUND = stroke(*BACK, ink=[ink("rock", period=11.3, roughness=0.41)], radius=30)


def texture(maker: str, name: str = "t", **members: Any) -> dict[str, Any]:
    return {"do": "texture", "name": name, "maker": maker, **members}


MADE: dict[str, dict[str, Any]] = {
    "image": texture("image", path="colour.png", period=37),
    "canvas": texture("canvas", rect=[0, 4, 3, 40, 36], detail=1),
    "spectrum": texture("spectrum", path="grey.png"),
    "spectrum-colour": texture("spectrum", path="colour.png", phase="zero", part="imag"),
    "spectrum-phase": texture("spectrum", path="colour.png", phase="grey.png", part="magnitude"),
    "spectrum-forward": texture("spectrum", path="grey.png", forward=True, part="log"),
    "spectrum-angle": texture("spectrum", path="grey.png", forward=True, part="phase"),
    "spectrum-shapes": texture(
        "spectrum",
        size=[64, 48],
        shapes=[
            {"shape": "ring", "frequency": 0.3},
            {"shape": "wedge", "angle": 20},
            {"shape": "noise"},
            {"shape": "points"},
        ],
    ),
    "spectrum-strokes": texture(
        "spectrum", size=[64, 64], strokes=[{"points": [[20, 40], [44, 40]], "brush": {"radius": 5}}]
    ),
    "sparse": texture("sparse", path="colour.png", density=12, quantise=5),
    "sparse-turned": texture("sparse", path="grey.png", density=3, turn=0.7),
    "impulse": texture("impulse", path="grey.png", window=16, average=5),
    "impulse-usual": texture("impulse", path="colour.png"),
    "impulse-random": texture("impulse", path="colour.png", phase="random", field="tile"),
    "solid": texture("solid", material="agate", normal=[1, -1, 2], depth=0.4, unit=24, seed=3, values={"bands": 9}),
    "gradient": texture("gradient", ramp=RAMP, **{"from": [3, 9], "to": [71, 50]}),
    "expression": texture("expression", text=WRITTEN, period=31, values={"deep": 0.4}),
    "expression-colours": texture("expression", text=WRITTEN_COLOURS, seed=3),
    "expression-named": texture(
        "expression", text='mix("rock"(x*3, y), "moss"(y, x + "stripes"()), "leaves"())', seed=2
    ),
    "gradient-radial": texture("gradient", kind="radial", ramp=RAMP, **{"from": [41, 33], "to": [77, 50]}),
    "gradient-angular": texture("gradient", kind="angular", level=1, ramp=RAMP, **{"from": [80, 61], "to": [77, 20]}),
    "match": texture("match", path="colour.png", iterations=2, levels=3),
    "match-laplacian": texture("match", path="grey.png", iterations=2, levels=3, pyramid="laplacian"),
    "match-alpha": texture("match", path="blob.png", iterations=2, levels=2, size=[32, 32]),
    "match-bands": texture(
        "match", path="colour.png", iterations=1, levels=2, bands=[{"level": 0, "gain": 2.0}], axes=[1, 2, 0.5, 1]
    ),
    "match-objects": texture("match", path="colour.png", structure="objects", detail="learnt", size=[48, 40]),
    "learn": texture("learn", path="colour.png", period=150),
    "mix-palette": texture("mix", path="colour.png", pattern="grey.png", iterations=2, levels=3),
    "mix-bands": texture("mix", path="colour.png", pattern="grey.png", how="bands", split=1, iterations=2, levels=3),
    "mix-average": texture(
        "mix", path="colour.png", pattern="grey.png", how="average", stages=3, iterations=2, levels=3
    ),
}


def _grown() -> Iterator[tuple[str, list[Any]]]:
    defined = texture("example", path="blob.png")
    grow = stroke(mode="example", example="t", radius=17)
    yield "example", [defined, grow]
    as_it_is = texture("example", path="blob.png", smooth=1.7, channels="luminance")
    yield "example-luminance", [as_it_is, grow, stroke(*BACK, mode="example", example="t", radius=8)]
    thin = stroke(*BACK, mode="example", example="t", radius=4)
    yield "example-seamless", [texture("example", path="blob.png", method=2, detail="learnt"), grow, thin]
    yield "example-mask", [texture("example", path="colour.png", mask="grey.png", kappa=2), grow]
    over = stroke(*BACK, mode="example", example="u", radius=9, depth=1, example_detail=1)
    other = texture("example", "u", path="colour.png")
    yield "example-over", [defined, other, grow, over, {"do": "swap", "at": [40, 30], "example": "u"}]
    maps = {"orientation": {"strokes": [{"points": [[9, 20], [30, 26]]}], "turns": 8}, "rim": {"width": 9}}
    lit = {"points": [[9, 9], [20, 14]], "brush": {"radius": 6, "colour": "#c0c0c0"}}
    told = texture("example", path="blob.png", maps=maps | {"glow": {"strokes": [lit]}}, levels=3)
    follows = stroke(mode="example", example="t", radius=11, control={"orientation": "stroke", "glow": 0.4})
    yield "example-told", [told, follows, stroke(*BACK, mode="example", example="t", radius=8, control={})]
    yield "example-painted-over", [defined, grow, stroke(*BACK, radius=5)]


def _brushes() -> Iterator[tuple[str, list[Any]]]:
    yield "plain", [stroke(), stroke(*BACK, hardness=1, spacing=0.1), stroke(*BACK, level=3), stroke(level=-2)]
    for name, row in KINDS.items():
        if not row.pictured:
            given = {"period": 21.9, "roughness": 0.613} if name == "rock" else WAVES
            yield f"ink {name}", [stroke(ink=[ink(name, **given)]), stroke(*BACK, level=1, ink=[ink(name)])]
            yield f"grain {name}", [stroke(grain={"texture": name, "amount": 0.7, "period": 9.1})]
            yield f"density {name}", [stroke(density={"texture": name, "amount": 0.9, "shaping": [[0.1, 0], [0.7, 1]]})]
            yield f"tip {name}", [stroke(tip={"texture": name, "period": 8.3})]
    for name in CURVES:
        yield f"curve {name}", [stroke(ink=[ink("rock", shaping=name)])]
    yield "lasting", [GROUND, stroke(ink=[ink("rock", renew=False, period=21.9, roughness=0.613)])]
    for name in EDGES:
        yield f"edge {name}", [stroke(edge={"curve": name, "width": 0.7, "colour": "#102040"})]
    for name in ("erase", "smooth"):
        yield f"mode {name}", [GROUND, stroke(mode=name, ink=[ink("rock")])]
    trees = "row(scatter(fade(#408030, fill(circle(x, y, 0.9))), 4, 0.3, distance(x, y) < 0.6, 90*random(1)), 1, size)"
    placed = {"mode": "generate", "radius": 17, "ink": [ink("trees")]}
    yield "mode generate", [GROUND, texture("expression", "trees", text=trees), stroke(**placed)]
    yield "dynamics", [stroke(dynamics={"radius": "pressure", "flow": [[0, 0.3], [0.7, 0.9]]})]


def _operations() -> Iterator[tuple[str, list[Any]]]:
    given: dict[str, dict[str, Any]] = {
        "gamma": {"gamma": 1.37},
        "hue": {"turn": 41.7},
        "displace": {"distance": 11.3, "angle": 37.7},
        "clone": {"layer": "Layer 1", "offset": [7, -5]},
        "predict": {"window": 32},
    }
    for name in OPS:
        op = {"name": name, **given.get(name, {})}
        yield f"op {name}", [GROUND, stroke(mode="raster", op=op, ink=[ink("rock", period=19.1)])]
    by_texture = {"name": "displace", "by": "texture", "distance": 31, "angle": 11}
    yield "op displace by texture", [GROUND, stroke(mode="raster", op=by_texture, ink=[ink("stripes", **WAVES)])]
    for n, text in enumerate(FORMULAS):
        yield f"formula {n}", [GROUND, stroke(mode="raster", op={"formula": text}, ink=[ink("rock")])]


def _layered() -> Iterator[tuple[str, list[Any]]]:
    for blend in BLENDS:
        above = {"do": "layer", "add": "above"}
        set_it = {"do": "layer", "set": "above", "opacity": 0.7, "blend": blend}
        yield f"blend {blend}", [GROUND, above, stroke(ink=[ink("stripes", **WAVES)]), set_it]
    locked = {"do": "layer", "set": "Layer 1", "alpha_locked": True}
    yield "alpha locked", [GROUND, locked, stroke(ink=[ink("rock")]), {"do": "undo"}, {"do": "redo"}]


def _made() -> Iterator[tuple[str, list[Any]]]:
    for name, defined in MADE.items():
        part = ink("t", weight="pressure") if "stages" in defined else ink("t")
        yield f"maker {name}", [GROUND, defined, stroke(ink=[part], radius=25)]
    sample = MADE["sparse"]
    yield "tip sparse", [sample, stroke(tip={"texture": "t", "from": "window"}), stroke(*BACK, tip="t")]
    yield "extent", [sample, stroke(ink=[ink("t")], extent=True)]
    shaped = ink("t", shaping="power", period=19, roughness=0.37)
    yield "shaped", [MADE["spectrum"], stroke(ink=[shaped]), stroke(*BACK, density={"texture": "t"}, level=1)]


def _areas() -> Iterator[tuple[str, list[Any]]]:
    """What is done to areas at once, or several times in one step."""
    turned = {"centre": [45.5, 31.2], "count": 7, "mirror": [0.3, 0.7]}
    yield "symmetry", [{**stroke(radius=4.3, ink=[ink("rock", period=9.3)]), "symmetry": turned}]
    like = {"at": [40, 30], "tolerance": 0.31, "gap": 3}
    yield "fill", [GROUND, {"do": "fill", "like": like, "open": True, "brush": {"ink": [ink("rock", period=7.7)]}}]
    oval = {"do": "select", "ellipse": [1, 13, 17, 123, 91], "feather": 3.3}
    thinner = {"do": "select", "op": "intersect", "outline": [[5, 5], [90, 11.3], [40.7, 70]], "level": 0, "grow": 1.7}
    for name in ("paint", "erase", "smooth"):
        yield f"selected {name}", [GROUND, oval, thinner, stroke(mode=name, ink=[ink("rock")], radius=31)]
    line = {"at": [20, 11], "within": [[0, 0], [71, 4.3], [66, 55.7], [3, 50]], "regions": "all", "tolerance": 0.23}
    yield "within", [GROUND, {"do": "fill", "like": line, "brush": {"ink": [ink("rock", period=7.7)]}}]
    told = {"points": LINE, "brush": {"radius": 4.3, "hardness": 0.37}, "symmetry": turned}
    yield "selected by copies", [GROUND, {"do": "select", "stroke": told}, stroke(mode="smooth", radius=31)]
    tip = texture("image", path="blob.png", period=9)
    yield "tips in copies", [tip, {**stroke(tip={"texture": "t"}, radius=6.7), "symmetry": turned}]
    cell = {"do": "layer", "set": "above", "wrap": [0, -3, 5, 68, 44]}
    beyond = {"do": "select", "ellipse": [0, 61, -30, 90, 70]}
    torus = [{"do": "layer", "add": "above"}, cell, stroke(radius=19, ink=[ink("rock")]), beyond, stroke(mode="smooth")]
    yield "wrapped", [*torus, {"do": "fill", "like": {"at": [99, 9], "tolerance": 0.3}, "brush": {"colour": "#308070"}}]
    round_it = {"at": [20, 11], "within": [[0, 0], [71, 4.3], [66, 55.7]], "regions": "line"}
    yield "fill line", [GROUND, {"do": "fill", "like": round_it, "brush": {"colour": "#308070", "edge": "wet"}}]
    ruler = {"do": "guide", "name": "r", "kind": "perspective-3", "points": [[-90, 3], [210, 5.3], [40.7, 300]]}
    yield "guides", [ruler, GROUND, {**ruler, "points": [[-90, 3], [210, 7], [40, 300]], "snap": 0.3}, {"do": "undo"}]
    both = [{"name": "a", "part": [3, 4, 20, 30], "at": [-7, 5], "opacity": 0.7}, {"name": "b", "part": [0, 0, 36, 40]}]
    brought = {"do": "layer", "add": "two", "kind": "pictures", "texture": "t", "level": 1, "at": [9, 8]}
    yield "pictures", [GROUND, texture("image", path="blob.png"), {**brought, "children": both}]
    above, clip = {"do": "layer", "add": "above"}, {"do": "layer", "set": "above", "clip": True, "opacity": 0.7}
    merged = {"do": "layer", "merge": "above"}
    yield "clipped", [GROUND, above, stroke(ink=[ink("stripes", **WAVES)]), clip]
    hidden = {"do": "layer", "set": "above", "mask": {"op": "full"}}
    onto = {**stroke(ink=[ink("rock", period=9.9)], colour="#404040", radius=31), "onto": "mask"}
    yield "masked", [GROUND, above, stroke(ink=[ink("stripes", **WAVES)]), hidden, onto, {**onto, "level": 1}]
    yield "merged", [GROUND, above, stroke(ink=[ink("stripes", **WAVES)]), merged]
    again = {"do": "layer", "add": "again", "kind": "placement", "of": "Layer 1", "at": [31, -7]}
    yield "placed", [GROUND, {**again, "c": [0.6, 0.8]}, {**again, "add": "half", "levels": -1, "turn": 1}]
    yield (
        "placed masked",
        [
            GROUND,
            {**again, "turn": 1},
            {"do": "layer", "set": "again", "mask": {"op": "full"}},
            {**onto, "layer": "again"},
        ],
    )
    yield "baked", [GROUND, {**again, "c": [0.9, 0.3], "mirror": True}, {"do": "layer", "bake": "again"}]


def _wet() -> Iterator[tuple[str, list[Any]]]:
    """Strokes that take up what lies there, by each way of mixing, with hairs, a slender tip, ink and copies; and those
    that textures run along with."""
    under = [GROUND, stroke(*BACK, colour="#2040c0", radius=11)]
    taking = {"length": 0.83, "amount": 0.61}
    yield "wet-light", [*under, stroke(wet={**taking, "dilution": 0.23}, ink=[ink("rock", period=13.7)])]
    slender = {"ratio": 0.31, "angle": 37.3, "follow": "direction"}
    yield "wet-pigment", [*under, stroke(wet={**taking, "dilution": 0.4, "mixing": "pigment"}, shape=slender)]
    hairs = stroke(wet={**taking, "mixing": "pigment"}, shape={"bristles": 19, "ratio": 0.6}, level=3, radius=71)
    yield "wet-hairs", [*under, {**hairs, "points": [[8 * x, 8 * y, *rest] for x, y, *rest in LINE]}]
    running = {
        "ink": [ink("stripes", **WAVES), ink("rock", period=13.7)],
        "density": {"texture": "rock", "amount": 0.7},
    }
    for fixed in ("stroke", "dab"):
        command = stroke(fixed=fixed, shape={"ratio": 0.41, "angle": 21.7}, **running)
        yield f"fixed-{fixed}", [{**command, "copies": [[0.6, 0.8, 31, 7, True]]}]
    yield "fixed-wet", [*under, stroke(fixed="stroke", wet=taking, **running)]
    around = {"centre": [47.3, 31.1], "count": 3, "mirror": True}
    yield "wet-copies", [*under, {**stroke(wet=taking), "symmetry": around}]


def _heights() -> Iterator[tuple[str, list[Any]]]:
    """What is heaped on a layer of heights, and beside the paint of another, seen in the light."""
    land = {"do": "layer", "set": "Layer 1", "role": "height", "scale": 40}
    hill = stroke(height=7.3, ink=[ink("rock", period=23.1)], radius=29)
    yield "heaped", [GROUND, land, hill, stroke(*BACK, level=2, height="auto"), stroke(mode="smooth", height=2)]
    yield "eroded", [GROUND, land, hill, {"do": "erode", "rect": [0, 9, 7, 72, 50], "talus": 0.37, "seed": 3}]
    rect = {"do": "ground", "path": "blob.png", "rect": [0, 5, -7, 61, 43], "range": [0, 20.3], "rim": 3.7}
    yield "grounded", [GROUND, land, rect, hill]
    yield "impasto", [GROUND, stroke(impasto=3.7, radius=9), stroke(*BACK, mode="erase", radius=5)]


def recordings() -> dict[str, list[Any]]:
    """The commands of each recording, by its name."""
    parts: tuple[Iterable[tuple[str, list[Any]]], ...] = (
        _brushes(),
        _operations(),
        _layered(),
        _made(),
        _areas(),
        _wet(),
        _heights(),
        _grown(),
    )
    return {name: commands for part in parts for name, commands in part}


def pictures(folder: Path) -> None:
    """Writes the pictures that the recordings name; they are made of whole numbers alone."""
    y, x = np.mgrid[:40, :36]
    waves = (x * 7 + (y * y) // 9) % 64 * 3 + (x * 5167 + y * 7919 + (x * y) % 13 * 331) % 61
    colours = np.stack([waves, 255 - (waves + 5 * y) % 256, (waves * 3 + 2 * x) % 256], axis=2)
    inside = (x - 18) ** 2 + (y - 20) ** 2 < 256
    Image.fromarray(waves.astype(np.uint8)).save(folder / "grey.png")
    Image.fromarray(colours.astype(np.uint8)).save(folder / "colour.png")
    Image.fromarray(np.dstack([colours, 255 * inside]).astype(np.uint8)).save(folder / "blob.png")


def played(name: str, commands: list[Any], folder: Path, version: int) -> Painting:
    """The painting that commands give."""
    header = {"inkfall": version, "frame": FRAME, "seed": 3}
    lines = "\n".join(map(json.dumps, [header, *commands])).encode()
    return settled(replay(read_from(io.BytesIO(lines), name, folder)).painting, 1)


def hashes(painting: Painting, folder: Path) -> list[str]:
    """Of the pictures exported at 16 bits, and of all values of all layers at some places."""
    pixels, values = hashlib.sha256(), hashlib.sha256()
    for level, rect in (*PLACES[:2], (1, None)):
        export.export(folder / "out.png", export.Picture(painting, level, rect, depth=16))
        pixels.update(read_image(folder / "out.png", "out.png")[0].tobytes())
    for layer in layers(painting.root):
        for level, rect in (*PLACES, DEEP):
            for pyramid in (layer.pyramid, *(layer.heaps[unit] for unit in sorted(layer.heaps))):
                values.update(evaluate(pyramid, level, rect).data.tobytes())
    return [pixels.hexdigest()[:16], values.hexdigest()[:16]]


def main(folder: str, version: str, *names: str) -> None:
    """Plays them in a folder of this process's own, and prints what they hash to."""
    found = {}
    for name, commands in recordings().items():
        if not names or any(name.startswith(each) for each in names):
            try:
                found[name] = hashes(played(name, commands, Path(folder), int(version)), Path.cwd())
            except Exception as error:
                found[name] = [f"{type(error).__name__}: {error}"]
    json.dump(found, sys.stdout)


if __name__ == "__main__":
    main(*sys.argv[1:])
