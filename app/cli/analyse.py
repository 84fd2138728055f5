"""Tell what a picture is made of: spectra, autocorrelation, distinct colours and regions of one colour."""

from __future__ import annotations

import argparse
import json
import os
import re
from typing import TYPE_CHECKING, Any

from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output, grown, opened_painting
from app.cli.progress import Progress

if TYPE_CHECKING:
    import numpy as np

    from engine.numeric.analysis import Analysis

_PIXELS = 400_000_000
LAGS = 16  # displacements told of the autocorrelation


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("image", metavar="IMAGE", help="a PNG, JPEG or TIFF, or the frame of a painting, .ora")
    parser.add_argument("--rect", type=area, metavar="X,Y,W,H", help="only this rectangle, in pixels of the image")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--png", metavar="P.png", help="write a sheet with pictures of all that is found")


def area(text: str) -> tuple[int, int, int, int]:
    """`X,Y,W,H`: integers, W and H at least 1."""
    expected = "expected X,Y,W,H: four integers, W and H at least 1"
    parts = text.split(",")
    if len(parts) != 4 or not all(re.fullmatch(r"\s*[+-]?[0-9]{1,18}\s*", part) for part in parts):
        raise argparse.ArgumentTypeError(f"found {text[:80]!r}, {expected}")
    x, y, width, height = (int(part) for part in parts)
    if width < 1 or height < 1:
        raise argparse.ArgumentTypeError(f"found {text[:80]!r}, {expected}")
    return x, y, width, height


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    checked_output(options.png, (".png",))
    pixels, notes = _read(options.image)
    height, width = pixels.shape[:2]
    x, y, wide, high = options.rect or (0, 0, width, height)
    if x < 0 or y < 0 or x + wide > width or y + high > height:
        raise Refused(f"--rect: found {x},{y},{wide},{high}, expected one within the image of {width} x {height}")
    from engine.numeric.analysis import Analysis

    found = Analysis(pixels[y : y + high, x : x + wide])
    told = {
        "file": options.image,
        "image": [width, height],
        "rect": [x, y, wide, high],
        **_facts(found),
        "notes": notes,
    }
    if options.png is not None:
        _write(options.png, found)
        told["written"] = options.png
    if options.json:
        print(json.dumps(told))
    else:
        _print(told)
    return DONE


def _read(path: str) -> tuple[np.ndarray, list[str]]:
    """RGBA (h, w, 4) of 8 or 16 bits, and what is to be told of the file."""
    from engine.files.images import read_image

    if not path.lower().endswith(".ora"):
        pixels, meta = read_image(path)
        return pixels, list(meta.notes)
    import numpy as np

    from engine.numeric.colour import to_rgba8
    from engine.painting.rendering import folded_layers, strips

    found = opened_painting(path)
    frame = found.painting.frame
    if frame.area > _PIXELS:
        raise Refused(f"{path}: found a frame of {frame.width} x {frame.height}, expected at most {_PIXELS} pixels")
    out = np.empty((frame.height, frame.width, 4), np.uint8)
    root, row = folded_layers(grown(path, found).root), 0
    with Progress("drawing", frame.height) as tell:
        for strip in strips(root, 0, frame):
            out[row : row + strip.shape[1]] = to_rgba8(strip)
            row += strip.shape[1]
            tell(row)
    return out, list(found.notes)


def _facts(found: Analysis) -> dict[str, Any]:
    """Returns what there is to know, ready for JSON."""
    height, width = found.pixels.shape[:2]
    frequencies, measured, fitted = found.radial
    high, wide = found.grey.shape
    across = found.autocorrelation[high // 2, wide // 2 :][:LAGS]
    down = found.autocorrelation[high // 2 :, wide // 2][:LAGS]
    predictor = found.predictor
    return {
        "bits": 8 * found.pixels.dtype.itemsize,
        "pixels": height * width,
        "colours": found.colours,
        "regions": found.regions,
        "mean": float(found.grey.mean()),
        "deviation": float(found.grey.std()),
        "slope": found.slope,
        "spectrum": {
            "size": [wide, high],
            "frequencies": _numbers(frequencies),
            "power": _numbers(measured),
            "all_pole": _numbers(fitted),
        },
        "autocorrelation": {"across": _numbers(across), "down": _numbers(down)},
        "all_pole": {
            "reach": predictor.reach,
            "stable": predictor.stable,
            "radius": predictor.radius,
            "shrunk": predictor.shrunk,
            "residual": float(predictor.residual[0]),
        },
    }


def _numbers(values: np.ndarray) -> list[float]:
    return [float(f"{value:.6g}") for value in values]


def _write(path: str, found: Analysis) -> None:
    from app.cli.sheet import sheet
    from engine.files.atomic import replacing
    from engine.files.png_writer import write_png

    pixels = sheet(found)
    with replacing(path) as file:
        write_png(file, pixels)


def _print(told: dict[str, Any]) -> None:
    x, y, wide, high = told["rect"]
    print(f"{os.path.basename(told['file'])}: {wide} x {high} pixels of {told['bits']} bits, at {x}, {y}")
    print(f"{told['colours']:,} distinct colours, {told['regions']:,} regions of one colour")
    print(f"brightness {told['mean']:.3f}, deviation {told['deviation']:.3f}")
    if told["slope"] is not None:
        print(f"amplitude falls with frequency as 1/f^{told['slope']:.2f}")
    near = told["autocorrelation"]
    print(f"autocorrelation across {_row(near['across'])}")
    print(f"autocorrelation down   {_row(near['down'])}")
    filter_ = told["all_pole"]
    how = "stable as fitted" if filter_["shrunk"] == 1.0 else f"made stable by {filter_['shrunk']:.3f} a pixel"
    print(
        f"all-pole filter of reach {filter_['reach']}: outermost pole at {filter_['radius']:.3f}, {how}; "
        f"error of prediction {filter_['residual']:.4f}"
    )
    for note in told["notes"]:
        print(f"note: {note}")
    if "written" in told:
        print(f"wrote {told['written']}")


def _row(values: list[float]) -> str:
    return " ".join(f"{value:+.2f}" for value in values[1:9]) or "none: a single pixel"
