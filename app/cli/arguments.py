"""Reading arguments: one line for what is wrong, rectangles of integers of any size."""

from __future__ import annotations

import argparse
import importlib
import re
from collections.abc import Mapping
from typing import NamedTuple, NoReturn

from app.cli.outcome import Refused

SIDE = 1 << 20  # pixels each way of what is made

MODULES = {  # of commands whose modules have other names
    "export": "export_command",
    "ground": "landscape.map_as_land",
    "solid": "solid_picture",
    "terrain": "landscape.terrain_command",
}
_RECTANGLE = re.compile(r"-?\d+(\.\d+)?(,-?\d+(\.\d+)?)*")


class Rectangle(NamedTuple):
    """`--rect L,X,Y,W,H`: the level, and the rectangle in pixels of it."""

    level: int
    x: int
    y: int
    width: int
    height: int


class Parser(argparse.ArgumentParser):
    """As the standard one, but an error is raised, in one line."""

    def error(self, message: str) -> NoReturn:
        """Refuses the arguments in one line, where argparse would print its usage."""
        raise Refused(f"{message} (see {self.prog} --help)")


def run_command(name: str, words: list[str]) -> int:
    """Carries out a command of app.cli with its arguments; returns the exit status."""
    module = importlib.import_module(f"app.cli.{MODULES.get(name, name)}")
    parser = Parser(prog=f"inkfall {name}", description=module.__doc__, allow_abbrev=False)
    module.declare(parser)
    status: int = module.run(parser.parse_args(joined_options(words)))
    return status


def run_option(words: list[str], commands: Mapping[str, str]) -> int:
    """`inkfall --help` and `inkfall --version`."""
    lines = [f"  {name:<10} {about}" for name, about in commands.items()]
    parser = Parser(
        prog="inkfall",
        usage="inkfall [FILE] | inkfall COMMAND ...",
        description="Paint that keeps revealing detail as you zoom in.  With a FILE (.ora, image, recording) or "
        "with nothing, the window opens.",
        epilog="\n".join(["commands:", *lines, "", "inkfall COMMAND --help tells more."]),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="store_true", help="tell the version")
    if parser.parse_args(words).version:
        from importlib.metadata import PackageNotFoundError, version

        try:
            print(f"inkfall {version('inkfall')}")
        except PackageNotFoundError:
            print("inkfall, run from its sources")
    return 0


def joined_options(words: list[str]) -> list[str]:
    """`--rect -4,0,0,8,8` as `--rect=-4,0,0,8,8`: argparse would take the value for an option."""
    out: list[str] = []
    for word in words:
        if (
            out
            and out[-1]
            in ("--rect", "--origin", "--at", "--flight", "--camera", "--sun", "--turn", "--light", "--range")
            and _RECTANGLE.fullmatch(word)
        ):
            out[-1] += f"={word}"
        else:
            out.append(word)
    return out


def rectangle(text: str) -> Rectangle:
    """`L,X,Y,W,H`: integers of any size, W and H at least 1."""
    parts = text.split(",")
    expected = "expected L,X,Y,W,H: five integers, W and H at least 1"
    if len(parts) != 5 or not all(re.fullmatch(r"\s*[+-]?[0-9]{1,4000}\s*", part) for part in parts):
        raise argparse.ArgumentTypeError(f"found {text[:80]!r}, {expected}")
    found = Rectangle(*(int(part) for part in parts))
    if found.width < 1 or found.height < 1 or abs(found.level) > 4096:
        raise argparse.ArgumentTypeError(f"found {text[:80]!r}, {expected}, L from -4096 to 4096")
    return found


def light(text: str) -> tuple[float, float, float]:
    """`AZIMUTH,ALTITUDE,DEPTH`: degrees clockwise from the top, degrees above the picture, pixels."""
    parts = text.split(",")
    if len(parts) != 3 or not all(re.fullmatch(r"\s*[+-]?[0-9]{1,6}(\.[0-9]{0,9})?\s*", part) for part in parts):
        raise argparse.ArgumentTypeError(f"found {text[:80]!r}, expected AZIMUTH,ALTITUDE,DEPTH: three numbers")
    azimuth, altitude, depth = (float(part) for part in parts)
    return azimuth, altitude, depth


def pixel(text: str) -> tuple[int, int, int]:
    """`L,X,Y`: a level and a pixel of it, integers of any size."""
    parts = text.split(",")
    right = len(parts) == 3 and all(re.fullmatch(r"\s*[+-]?[0-9]{1,4000}\s*", part) for part in parts)
    if not right or abs(int(parts[0])) > 4096:
        raise argparse.ArgumentTypeError(f"found {text[:80]!r}, expected L,X,Y: three integers, L from -4096 to 4096")
    level, x, y = (int(part) for part in parts)
    return level, x, y


def count(text: str) -> int:
    """Reads a whole number from 0."""
    if not re.fullmatch(r"[0-9]{1,18}", text):
        raise argparse.ArgumentTypeError(f"found {text[:40]!r}, expected a whole number from 0")
    return int(text)


def seed(text: str) -> int:
    """Reads a seed."""
    if not re.fullmatch(r"[+-]?[0-9]{1,18}", text):
        raise argparse.ArgumentTypeError(f"found {text[:40]!r}, expected a whole number of up to 18 digits")
    return int(text)


def size(text: str) -> tuple[int, int]:
    """`WxH`: width and height."""
    found = re.fullmatch(r"([0-9]{1,8})[x×]([0-9]{1,8})", text)
    width, height = (int(part) for part in found.groups()) if found else (0, 0)
    if not (1 <= width <= SIDE and 1 <= height <= SIDE):
        raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected WxH, each from 1 to {SIDE} pixels")
    return width, height


def read_place(text: str) -> tuple[int, int]:
    """`X,Y`: integers of any size."""
    if not re.fullmatch(r"[+-]?[0-9]{1,2000},[+-]?[0-9]{1,2000}", text):
        raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected X,Y: two integers")
    x, y = text.split(",")
    return int(x), int(y)
