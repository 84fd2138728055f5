"""`inkfall texture example`: the white part of a picture filled with an example texture (Ritter et al. 2006)."""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from app.cli.arguments import Parser, seed
from app.cli.match_command import MOST, PICTURE, whole, write
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output
from app.cli.progress import Progress

if TYPE_CHECKING:
    from concurrent.futures import Executor

    import numpy as np

    from engine.texture.example.exemplar import Exemplar
    from engine.texture.example.parameters import Parameters

# Options that stand for a field of the parameter file, and what reads them.
_FIELDS: dict[str, type] = {"kappa": float, "neighbourhood": int, "levels": int, "every": int, "method": str}
ABOUT = "Fills the white part of a picture with a texture like an example, rim and transparency included"
_PIXELS = 1 << 27  # of a region's picture


def run(words: list[str]) -> int:
    """Carries the command out; returns the exit status."""
    given = _parser().parse_args(words)
    checked_output(given.out, (".png",))
    _check_paths(given)
    parameters = _parameters(given)
    from engine.strokes.example_files import read_mask

    region = read_mask(given.region)
    _check_size(given, region)
    exemplar = _exemplar(given, parameters)
    pixels = _fill(exemplar, region, given)
    write(given.out, pixels)
    _tell(given, exemplar, region, pixels)
    return DONE


def _parser() -> Parser:
    parser = Parser(prog="inkfall texture example", description=ABOUT, allow_abbrev=False)
    parser.add_argument("example", metavar="EXAMPLE", help=f"at most 1024 x 1024: {PICTURE}")
    parser.add_argument("--region", metavar="R.png", required=True, help="its white part is filled")
    parser.add_argument("--out", metavar="P.png", required=True, help="where the picture goes")
    parser.add_argument("--mask", metavar="M.png", help="the example's region is white in it (default: alpha > 0)")
    parser.add_argument("--params", metavar="P.toml", help="parameters of the example; options here go before it")
    parser.add_argument(
        "--told",
        action="append",
        default=[],
        metavar="NAME=P.png",
        help="what the picture, as large as R, tells of a map that the parameters name: orientation, grey being a part"
        " of a turn, clockwise from rightwards, or another",
    )
    parser.add_argument("--kappa", type=float, metavar="K", help="larger: larger pieces of the example (default 2)")
    parser.add_argument("--neighbourhood", type=int, metavar="N", help="pixels along it: 3, 5 or 7 (default 7)")
    parser.add_argument("--levels", type=int, metavar="N", help="of the pyramid (default: by the example's size)")
    parser.add_argument("--every", type=int, metavar="K", help="search for one in K (default 8)")
    parser.add_argument(
        "--method", type=_method, metavar="M", help="2, without seams (default), correction, as before, or scanline"
    )
    parser.add_argument("--threads", type=whole(1, MOST), metavar="N", help="default: as many as there are cores")
    parser.add_argument("--seed", type=seed, default=0, metavar="S", help="another seed, another texture (default 0)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    return parser


def _method(text: str) -> str | int:
    return int(text) if text.isdecimal() else text


def _check_paths(given: argparse.Namespace) -> None:
    for path in (given.example, given.region, given.mask, given.params):
        if path and os.path.exists(given.out) and os.path.exists(path) and os.path.samefile(given.out, path):
            raise Refused(f"{given.out}: found {path} itself, expected another file")


def _parameters(given: argparse.Namespace) -> Parameters:
    from engine.checks.field_error import FieldError
    from engine.strokes.example_files import read_parameters
    from engine.texture.example.parameters import NEW, with_values

    parameters = read_parameters(given.params, NEW) if given.params else NEW
    told = {name: getattr(given, name) for name in _FIELDS if getattr(given, name) is not None}
    try:
        return with_values(parameters, told, "--")
    except FieldError as error:
        raise Refused(str(error)) from None


def _exemplar(given: argparse.Namespace, parameters: Parameters) -> Exemplar:
    """Returns the example, with the maps that its parameters name."""
    from engine.checks.field_error import FieldError
    from engine.strokes import example_maps
    from engine.strokes.example_files import read_exemplar, read_map_table

    try:
        maps = example_maps.read_maps(read_map_table(given.params) if given.params else {})
        if not maps:
            return read_exemplar(given.example, given.mask, parameters)
        return example_maps.read_controlled(given.example, given.mask, parameters, maps, Path(given.params).parent)
    except FieldError as error:
        raise Refused(f"{given.params}: {error}") from None


def _told(exemplar: Exemplar, region: np.ndarray, given: argparse.Namespace) -> np.ndarray | None:
    """Returns what pictures tell of the region, by the maps that are not found of it: uint8 (maps, h, w); None where
    there are none."""
    import numpy as np

    from engine.strokes.example_maps import read_told
    from engine.texture.example.control import stored_channels

    control = exemplar.control
    names = [] if control is None else [channel.name for channel in stored_channels(control.channels)]
    usual = () if control is None else control.usual
    planes = [np.full(region.shape, value, np.uint8) for value in usual]
    for option in given.told:
        name, _, path = option.partition("=")
        if name not in names or not path:
            raise Refused(f"--told: found {option}, expected NAME=P.png, NAME one of {', '.join(names) or 'none'}")
        planes[names.index(name)] = read_told(path, region.shape)
    return np.stack(planes) if planes else None


def _check_size(given: argparse.Namespace, region: np.ndarray) -> None:
    if region.size > _PIXELS:
        height, width = region.shape
        raise Refused(f"{given.region}: found {width} x {height} pixels, expected at most {_PIXELS} in all")


def _fill(exemplar: Exemplar, region: np.ndarray, given: argparse.Namespace) -> np.ndarray:
    """Returns pixels of the picture: RGBA (h, w, 4) of the example's type."""
    from engine.numeric.address import Rect
    from engine.texture.example import show
    from engine.texture.example.region import empty, painted, refining

    height, width = region.shape
    rect = Rect(0, 0, width, height)
    if exemplar.parameters.method == "scanline":
        from engine.texture.example.scanline import filled

        return filled(exemplar, region, given.seed)
    grown = painted(empty(exemplar, given.seed), rect, region, values=_told(exemplar, region, given))
    count = len(exemplar.levels)
    with Progress("growing", 100) as bar, _threads(given.threads) as pool:
        for step in refining(grown, threads=pool):
            grown = step.region
            # Each level has four times the pixels of the one above.
            bar.part((step.done + 1 / 3) * 0.25**step.level * 0.75 if step.level < count else 0.0)
    return show.pixels(grown, rect)


@contextmanager
def _threads(count: int | None) -> Iterator[Executor | None]:
    """None for one."""
    from concurrent.futures import ThreadPoolExecutor

    count = count or min(os.cpu_count() or 1, MOST)
    if count == 1:
        yield None
        return
    with ThreadPoolExecutor(count) as pool:
        try:
            yield pool
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise


def _tell(given: argparse.Namespace, exemplar: Exemplar, region: np.ndarray, pixels: np.ndarray) -> None:
    height, width = region.shape
    facts: dict[str, Any] = {
        "written": given.out,
        "size": [width, height],
        "filled": int(region.sum()),
        "bits": 8 * pixels.dtype.itemsize,
        "seed": given.seed,
        **asdict(exemplar.parameters),
        "levels": len(exemplar.levels),
        "boundary": exemplar.boundary,
        "maps": [] if exemplar.control is None else [channel.name for channel in exemplar.control.channels],
    }
    if given.json:
        print(json.dumps(facts))
        return
    if given.levels and given.levels > len(exemplar.levels):
        print(f"{len(exemplar.levels)} levels: the example has no room for {given.levels}")
    if not facts["filled"]:
        print(f"{given.region} has no white part: nothing was filled")
    print(f"wrote {given.out}: {width} x {height} pixels, {facts['filled']} of them filled, {facts['bits']} bits")
