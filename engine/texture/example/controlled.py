"""An example that has control channels, analysed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.colour import to_rgba16
from engine.numeric.halving import halved_region
from engine.texture.example import exemplar as exemplars
from engine.texture.example.control import (
    NO_WEIGHTS,
    Channels,
    Control,
    counts,
    halved_planes,
    mean_direction,
    rim_of,
    stored_channels,
)
from engine.texture.example.exemplar import PAD, Exemplar, by_way
from engine.texture.example.parameters import ORIENTATION, RIM_CHANNEL, Parameters
from engine.texture.example.turning import Copies, copies_of, mask_rect, turned_copies


def analysed_with(
    pixels: np.ndarray,
    mask: np.ndarray | None,
    parameters: Parameters,
    told: tuple[Channels, np.ndarray],
    arithmetic: int = LIBRARY,
) -> Exemplar:
    """As `exemplar.analysed`, of an example whose channels, in order, tell planes, uint8 (channels, h, w); a rim of
    which all is 0 is as its mask tells.

    With an orientation the example is learnt from turned all round, and its pixels are those of all copies.
    """
    channels, planes = told
    region = exemplars.region_of(pixels, mask, parameters, arithmetic)
    boundary = exemplars.has_rim(region, parameters)
    count = exemplars.level_count(region, parameters, boundary)
    usual = _usual(channels, planes, region)
    copies = None
    if channels[0].name == ORIENTATION and channels[0].turns > 1:
        place = mask_rect(region).slices(Rect(0, 0, region.shape[1], region.shape[0]))
        colours, region = exemplars.premultiplied(pixels)[place], region[place]
        copies = copies_of(region.shape, channels[0].turns, count)
        colours, region, planes = turned_copies(colours, region, planes[:, *place], copies, not boundary)
        pixels = to_rgba16(np.ascontiguousarray(colours.transpose(2, 0, 1)))
    control = _control(channels, planes, region, (count, copies), usual)
    found = exemplars.of_levels(pixels, region, parameters, (count, boundary), arithmetic, control)
    if copies is None:
        return found
    number = copies.number
    levels = [
        by_way(level, np.pad(copies.ways(told[0, PAD:-PAD, PAD:-PAD], n), PAD), number)
        for n, (level, told) in enumerate(zip(found.levels, control.levels, strict=True))
    ]
    return replace(found, levels=tuple(levels))


def _usual(channels: Channels, planes: np.ndarray, region: np.ndarray) -> tuple[int, ...]:
    """Returns the mean of each stored channel over the region."""
    found = []
    for channel, plane in zip(stored_channels(channels), planes, strict=False):
        inside = plane[region]
        goes_round = channel.name == ORIENTATION
        found.append(mean_direction(inside) if goes_round else int(inside.sum(dtype=np.int64)) // inside.size)
    return tuple(found)


def _control(
    channels: Channels, planes: np.ndarray, region: np.ndarray, shape: tuple[int, Copies | None], usual: tuple[int, ...]
) -> Control:
    count, copies = shape
    own, levels, turns = planes, [], []
    painted = channels[-1].name == RIM_CHANNEL and bool(planes[-1].any())
    for n in range(count):
        if n:
            own, region = halved_planes(own, region), halved_region(region)
        seen = own
        if channels[-1].name == RIM_CHANNEL and not painted:
            seen = np.concatenate([own[:-1], rim_of(region, channels[-1].width, n)[None]])
        if channels[-1].name == RIM_CHANNEL and not counts(n, count):
            seen = seen.copy()
            seen[-1] = 0
        levels.append(_frozen(np.pad(seen, [(0, 0), (PAD, PAD), (PAD, PAD)])))
        turns.append(NO_WEIGHTS if copies is None else copies.table(n))
    return Control(channels, tuple(levels), tuple(turns), usual)


def _frozen(planes: np.ndarray) -> np.ndarray:
    planes.flags.writeable = False
    return planes
