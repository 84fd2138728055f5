"""What `match` and `mix` make where a definition names a structure: joint statistics, and an example's layout as far as
it is asked for (`engine.texture.structure`).

Worked out in one arithmetic, the same on every machine.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence

import numpy as np

from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields
from engine.numeric.arithmetic import EVERYWHERE
from engine.numeric.colour_axes import ColourAxes, axes_of
from engine.texture.matching import noise
from engine.texture.structure.copied import copied_share
from engine.texture.structure.made import STRUCTURES, structured
from engine.texture.structure.statistics import Joint, analysing, joint_between
from engine.texture.structure.synthesis import colours_of

NO_STRUCTURE = "none"
ALL = (NO_STRUCTURE, *STRUCTURES)
OF_NONE = (
    "pyramid",
    "levels",
    "orientations",
    "iterations",
    "start",
    "bands",
    "axes",
)  # members that mean nothing else
_SMALL = 72  # pixels along the sides of a texture that nobody sees
_LARGEST = 1024  # pixels along an example's sides that are looked at


def structure_of(members: Fields, how: str) -> str:
    """Returns the structure that a definition names; FieldError names what does not go with it.  `how`: the way in
    which two examples are mixed, "average" for one."""
    structure: str = members.take("structure", NO_STRUCTURE)
    if structure not in ALL:
        raise members.fault("structure", f"one of {', '.join(ALL)}")
    if structure == NO_STRUCTURE:
        return structure
    for name in OF_NONE:
        if name in members:
            raise FieldError(members.at(name), "it", f'"structure": "none", of which alone it is, not "{structure}"')
    if how != "average":
        raise FieldError(members.at("how"), f'"{how}"', f'average: there is no other of "structure": "{structure}"')
    return structure


def texture_steps(
    examples: Sequence[np.ndarray], structure: str, weight: float, size: tuple[int, int], seed: int
) -> Iterator[tuple[float, np.ndarray | None]]:
    """Yields how far the work is, 0..1, and now and then the colours (C, *size), float32 in 0..1; last those of the
    finished texture.  `examples` (1, 3 or 4, h, w): one, or two to be mixed by the weight of the second."""
    pictures = _alike([looked_at(example) for example in examples])
    wanted = yield from _wanted(pictures, weight)
    for stage in structured(pictures[0], wanted, structure, size, seed):
        colours = None
        if stage.planes is not None and stage.planes.shape[1:] == size:
            colours = colours_of(wanted, stage.planes)
        yield 0.02 + 0.98 * stage.done, colours


def make_once() -> None:
    """Makes a small texture of each kind, so that all kernels are compiled and kept."""
    picture = np.ascontiguousarray(0.5 + 0.4 * noise(3, (_SMALL, _SMALL), 1), np.float32)
    for structure in ("statistics", "full"):
        made = picture
        for _, colours in texture_steps([picture, picture], structure, 0.5, (_SMALL, _SMALL), 0):
            made = made if colours is None else colours
        copied_share(picture, made)


def _wanted(pictures: list[np.ndarray], weight: float) -> Generator[tuple[float, np.ndarray | None], None, Joint]:
    """Yields between pieces of work; returns the statistics of one picture, or those between two along axes that serve
    both."""
    if len(pictures) == 1:
        return (yield from _analysed(pictures[0], None))
    channels = len(pictures[0])
    axes = axes_of(np.concatenate([picture.reshape(channels, -1) for picture in pictures], axis=1), EVERYWHERE)
    one = yield from _analysed(pictures[0], axes)
    other = yield from _analysed(pictures[1], axes)
    return joint_between(one, other, weight)


def _analysed(picture: np.ndarray, axes: ColourAxes | None) -> Generator[tuple[float, np.ndarray | None], None, Joint]:
    work = analysing(picture, axes)
    while True:
        try:
            next(work)
        except StopIteration as stop:
            found: Joint = stop.value
            return found
        yield 0.0, None


def looked_at(picture: np.ndarray) -> np.ndarray:
    """Returns the middle of a picture that is larger than what is looked at."""
    top, left = (max(0, (n - _LARGEST) // 2) for n in picture.shape[1:])
    return np.ascontiguousarray(picture[:, top : top + _LARGEST, left : left + _LARGEST])


def _alike(pictures: list[np.ndarray]) -> list[np.ndarray]:
    """Returns pictures with as many channels as that with most: grey becomes RGB, what has no alpha is opaque."""
    most = max(map(len, pictures))
    return [_widened(picture, most) for picture in pictures]


def _widened(picture: np.ndarray, channels: int) -> np.ndarray:
    if len(picture) == 1 < channels:
        picture = np.repeat(picture, 3, axis=0)
    if len(picture) == 3 < channels:
        picture = np.concatenate([picture, np.ones((1, *picture.shape[1:]), np.float32)])
    return picture
