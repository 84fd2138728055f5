"""Textures matched to examples, `match` and `mix`: their arguments, the pictures they start from, what they write."""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from app.cli.arguments import Parser, seed, size
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output
from app.cli.progress import Progress

if TYPE_CHECKING:
    from concurrent.futures import Executor

    import numpy as np

    from engine.texture.matching import Pattern, Shape, Step

PYRAMIDS = ("steerable", "laplacian")
HOWS = ("palette", "bands", "average")
STRUCTURES = ("none", "statistics", "coarse", "objects", "full", "pieces")
OF_NONE = ("--pyramid", "--levels", "--orientations", "--iterations", "--exact", "--start")  # options
MOST = 8  # threads at most
_BYTES = 230  # for each pixel and channel of a texture with a structure
_PIXELS = 1 << 24  # of a texture with a structure, at most
_LONG = 90.0  # seconds from which on it is told how long it takes
_HISTOGRAMS, _STRUCTURED = 1.6e-6, 5e-6  # seconds of the processor for a pixel and channel, about
PICTURE = "a PNG, JPEG or TIFF; grey, RGB or RGBA, 8 or 16 bit"
ABOUT = {
    "match": "Texture like an example, of any size, that tiles without seams",
    "mix": "Texture between two examples, of any size, that tiles without seams",
}
# What the command line does otherwise than `engine.makers.heeger_bergen`, whose examples are read while one paints.
WHOLE = (
    "Examples are looked at whole, as they are.  As a brush's ink and in the window, one longer than 1024 pixels is "
    "halved until it is not, and the middle 512 x 512 are looked at."
)


@dataclass(frozen=True, slots=True, eq=False)
class ExampleArgument:
    """A picture: float32 (C, h, w) in 0..1, grey, RGB or premultiplied RGBA; and the bits of its samples."""

    path: str
    planes: np.ndarray
    bits: int

    @property
    def size(self) -> tuple[int, int]:
        """Returns height and width."""
        return self.planes.shape[1], self.planes.shape[2]


def run(name: str, words: list[str]) -> int:
    """`inkfall texture match` or `mix`."""
    given = _parser(name).parse_args(words)
    _check_structure(given, words)
    checked_output(given.out, (".png",))
    paths = [given.example] if name == "match" else [given.palette, given.pattern]
    examples = [read(path, given.out) for path in paths]
    last = examples[-1]
    start = read(given.start, given.out) if name == "match" and given.start else None
    width, height = given.size or (start or last).size[::-1]
    if given.structure != "none":
        return _structured(given, examples, (height, width))
    check_memory(height * width, examples, f"{width} x {height}", 44 + 12 * thread_count())
    _tell_how_long((width, height), examples, _HISTOGRAMS)
    pattern = _pattern(name, given, [example.planes for example in examples], (height, width))
    beginning = _beginning(pattern, start, given.seed, (height, width))
    from engine.texture.matching import matched_colours, matching

    with threads() as pool:
        planes = finished("matching", matching(pattern, beginning, given.iterations, pool, given.exact))
    depth = given.depth or max(example.bits for example in examples)
    pixels = pixels_of(matched_colours(pattern, planes), depth)
    write(given.out, pixels)
    tell(given, summary(given, pattern.shape, pixels) | {"size": [width, height]})
    return DONE


def _check_structure(given: argparse.Namespace, words: list[str]) -> None:
    """Refused, if options do not go with the structure that is asked for."""
    if given.structure == "none":
        return
    for option in OF_NONE:
        if any(word.split("=")[0] == option for word in words):
            raise Refused(f"{option}: found it, expected --structure none, of which alone it is, not {given.structure}")
    if getattr(given, "how", "average") != "average":
        raise Refused(f"--how: found {given.how}, expected average with --structure {given.structure}")


def _structured(given: argparse.Namespace, examples: list[ExampleArgument], size: tuple[int, int]) -> int:
    """Makes a texture with a structure, writes it and tells of it."""
    from engine.makers import with_structure
    from engine.texture.structure.copied import copied_share

    height, width = size
    if height * width > _PIXELS:
        raise Refused(f"--size: found {width} x {height}, expected at most {_largest(size)} with a structure")
    check_memory(height * width, [], f"{width} x {height}", _BYTES * max(len(example.planes) for example in examples))
    _tell_how_long((width, height), examples, _STRUCTURED)
    planes, colours = [example.planes for example in examples], None
    with Progress("matching", 100) as bar:
        for done, found in with_structure.texture_steps(
            planes, given.structure, getattr(given, "weight", 0.0), size, given.seed
        ):
            bar.part(done)
            colours = colours if found is None else found
    assert colours is not None
    pixels = pixels_of(colours, given.depth or max(example.bits for example in examples))
    write(given.out, pixels)
    copied = copied_share(with_structure.looked_at(planes[0]), colours)
    facts = {"structure": given.structure, "copied": round(copied, 3), "size": [width, height]}
    tell(given, _of_pixels(given, pixels) | facts)
    return DONE


def _largest(size: tuple[int, int]) -> str:
    """Names the largest size of the shape of one."""
    part = (_PIXELS / (size[0] * size[1])) ** 0.5
    return f"{int(size[1] * part)} x {int(size[0] * part)}"


def _tell_how_long(size: tuple[int, int], examples: list[ExampleArgument], each: float) -> None:
    """Says on standard error how long it takes where that is long: the bar is for terminals alone."""
    taken = size[0] * size[1] * max(len(example.planes) for example in examples) * each
    if taken >= _LONG:
        print(
            f"inkfall: {size[0]} x {size[1]} pixels take some {taken / 60.0:.0f} minutes", file=sys.stderr, flush=True
        )


def _parser(name: str) -> Parser:
    parser = Parser(prog=f"inkfall texture {name}", description=ABOUT[name], epilog=WHOLE, allow_abbrev=False)
    if name == "match":
        parser.add_argument("example", metavar="EXAMPLE", help=PICTURE)
        parser.add_argument("--start", metavar="IMAGE", help="begin with a picture, stretched to the size, not noise")
    else:
        parser.add_argument("palette", metavar="PALETTE", help=f"first example: {PICTURE}")
        parser.add_argument("pattern", metavar="PATTERN", help="second example")
        parser.add_argument(
            "--how",
            choices=HOWS,
            default="palette",
            help="colours of the first, pattern of the second; coarse bands of the first, fine ones of the second; "
            "average of all histograms (default palette)",
        )
        parser.add_argument("--weight", type=part, default=0.5, metavar="W", help="of the second, 0..1 (average)")
        parser.add_argument(
            "--split", type=whole(0, 16), default=2, metavar="LEVEL", help="finer levels are the second's (bands)"
        )
    parser.add_argument("--out", metavar="P.png", required=True, help="where the texture goes")
    parser.add_argument("--size", type=size, metavar="WxH", help="pixels (default: those of the picture)")
    parser.add_argument(
        "--structure",
        choices=STRUCTURES,
        default="none",
        help="how much of the example's structure is kept: none (histograms alone), statistics (nothing is copied), "
        "coarse, objects, full (its layout, to a quarter, to half and to all of the size), pieces (large, cut where "
        "they agree); default none",
    )
    parser.add_argument("--pyramid", choices=PYRAMIDS, default="steerable", help="default steerable")
    parser.add_argument("--exact", action="store_true", help="match histograms by rank, not by tables of 256 bins")
    add_common(parser, 5)
    return parser


def add_common(parser: Parser, iterations: int) -> None:
    """Declares the options of every maker that matches histograms."""
    parser.add_argument("--levels", type=whole(0, 16), default=4, metavar="N", help="of the pyramid (default 4)")
    parser.add_argument("--orientations", type=whole(1, 16), default=4, metavar="K", help="at each level (default 4)")
    parser.add_argument(
        "--iterations", type=whole(1, 1000), default=iterations, metavar="N", help=f"default {iterations}"
    )
    parser.add_argument("--seed", type=seed, default=0, metavar="S", help="another seed, another texture (default 0)")
    parser.add_argument("--depth", type=int, choices=(8, 16), help="bits (default: the example's)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def whole(low: int, high: int) -> Any:
    """Reads whole numbers from `low` to `high`."""

    def read_whole(text: str) -> int:
        if not re.fullmatch(r"[0-9]{1,9}", text) or not low <= int(text) <= high:
            raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected a whole number from {low} to {high}")
        return int(text)

    return read_whole


def part(text: str) -> float:
    """Reads a number from 0 to 1."""
    if not re.fullmatch(r"[0-9]{0,20}\.?[0-9]{0,20}", text) or text in ("", ".") or not 0.0 <= float(text) <= 1.0:
        raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected a number from 0 to 1")
    return float(text)


def read(path: str, out: str) -> ExampleArgument:
    """Returns a picture file; Refused or FileError says what is wrong with it."""
    from engine.files.images import read_image
    from engine.files.limits import LIMITS
    from engine.numeric.colour import from_rgba8, from_rgba16
    from engine.painting.capture import PIXELS_CAP

    if os.path.exists(out) and os.path.exists(path) and os.path.samefile(out, path):
        raise Refused(f"{out}: found the example itself, expected another file")
    pixels, _ = read_image(path, limits=replace(LIMITS, pixels=PIXELS_CAP))
    bits = 8 * pixels.dtype.itemsize
    planes = from_rgba8(pixels) if bits == 8 else from_rgba16(pixels)
    if (planes[3] != 1.0).any():
        return ExampleArgument(path, planes, bits)
    grey = (planes[1] == planes[0]).all() and (planes[2] == planes[0]).all()
    return ExampleArgument(path, planes[: 1 if grey else 3], bits)


def check_memory(pixels: int, examples: list[ExampleArgument], asked: str, each: int) -> None:
    """Refused, if so many pixels of `each` bytes for each channel, beside the examples, are beyond the machine."""
    from engine.files.limits import memory_cap

    most = max((len(example.planes) for example in examples), default=1)
    needed = each * most * pixels + sum(100 * example.planes.size for example in examples)
    if needed > memory_cap():
        raise Refused(
            f"--size: found {asked}, which takes {needed / (1 << 30):,.0f} GiB of memory, expected less than "
            f"{memory_cap() / (1 << 30):,.0f} GiB"
        )


def _pattern(name: str, given: argparse.Namespace, examples: list[np.ndarray], size: tuple[int, int]) -> Pattern:
    from engine.texture.matching import Shape, analysed
    from engine.texture.mixing import MIXES, Mix

    shape = Shape(given.pyramid, given.levels, given.orientations).within(size)
    if name == "match":
        return analysed(examples[0], shape)
    return MIXES[given.how](examples[0], examples[1], shape, Mix(given.weight, given.split))


def _beginning(pattern: Pattern, start: ExampleArgument | None, seed: int, size: tuple[int, int]) -> np.ndarray:
    """Returns noise, or the start picture stretched to the size, along its own axes of colour."""
    import numpy as np

    from engine.numeric.colour_axes import axes_of
    from engine.numeric.resample import resampled
    from engine.texture.matching import noise, started

    if start is None:
        return noise(pattern.colours.count, size, seed)
    stretched = resampled(start.planes, size, np.arange(size[0]), np.arange(size[1]))
    return started(pattern, axes_of(stretched).planes(stretched), seed)


def thread_count() -> int:
    """Gives how many threads matching takes here."""
    return min(os.cpu_count() or 1, MOST)


@contextmanager
def threads() -> Iterator[Executor | None]:
    """As many as there are cores; None for one."""
    from concurrent.futures import ThreadPoolExecutor

    if thread_count() == 1:
        yield None
        return
    with ThreadPoolExecutor(thread_count()) as pool:
        try:
            yield pool
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise


def finished(label: str, steps: Iterable[Step]) -> np.ndarray:
    """Returns the planes of the last step; a bar tells how far it is."""
    planes = None
    with Progress(label, 100) as bar:
        for step in steps:
            bar.part(step.done)
            planes = step.planes
    assert planes is not None
    return planes


def pixels_of(colours: np.ndarray, bits: int) -> np.ndarray:
    """Returns pixels (h, w, C), uint8 or uint16, of colours (C, h, w); alpha is not premultiplied in them."""
    import numpy as np

    from engine.numeric.colour import to_rgba8, to_rgba16

    count = len(colours)
    planes = np.ones((4, *colours.shape[1:]), np.float32)
    planes[: max(count, 3)] = colours
    if count == 4:
        np.clip(planes[:3], 0.0, planes[3], out=planes[:3])
    rgba = to_rgba8(planes) if bits == 8 else to_rgba16(planes)
    return np.ascontiguousarray(rgba[..., :count])


def write(path: str, pixels: np.ndarray) -> None:
    """Writes pixels (h, w, C) as a PNG, whole or not at all."""
    from engine.files.atomic import replacing
    from engine.files.png_writer import write_png

    with replacing(path) as file:
        write_png(file, pixels)


def summary(given: argparse.Namespace, shape: Shape, pixels: np.ndarray) -> dict[str, Any]:
    """Returns what there is to tell of a texture: the pyramid may have fewer levels than were asked for."""
    of_pyramid = {"levels": shape.levels, "orientations": shape.orientations, "iterations": given.iterations}
    return _of_pixels(given, pixels) | of_pyramid


def _of_pixels(given: argparse.Namespace, pixels: np.ndarray) -> dict[str, object]:
    bits = 8 * pixels.dtype.itemsize
    return {"written": given.out, "channels": pixels.shape[-1], "bits": bits, "seed": given.seed}


def tell(given: argparse.Namespace, facts: dict[str, Any]) -> None:
    """Prints what came of it: as JSON if that was asked for."""
    if given.json:
        print(json.dumps(facts))
        return
    if facts.get("levels", given.levels) < given.levels:
        count = facts["levels"]
        print(f"{count} level{'' if count == 1 else 's'}: the pictures have no room for {given.levels}")
    colours = {1: "grey", 3: "RGB", 4: "RGBA"}[facts["channels"]]
    across = " x ".join(map(str, facts["size"]))
    print(f"wrote {given.out}: {across} pixels, {colours}, {facts['bits']} bits")
    if "copied" in facts:
        print(f"{facts['copied']:.0%} of its 7 x 7 patches are copied from the example")
