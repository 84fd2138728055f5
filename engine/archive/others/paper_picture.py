"""The paper of a painting as other programs see it: a layer below all others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from engine.archive.others.spooled_png import SpooledPng
from engine.canvas.merging.paper import Paper
from engine.files.stack_xml import LayerEntry, StackEntry
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8

_ROWS = 64
_NAME = "data/paper.png"


def paper_names(paper: str | None) -> list[str]:
    """Returns the members that a paper needs."""
    return [] if paper is None else [_NAME]


def paper_pictures(paper: str | None, frame: Rect, count: int) -> dict[str, SpooledPng]:
    """Returns the pictures of a paper over the frame, one of `count`."""
    if paper is None:
        return {}
    png = SpooledPng(frame, count, small=True)
    rows = to_rgba8(Paper(paper).planes(Rect(0, 0, frame.width, min(_ROWS, frame.height))))
    for top in range(0, frame.height, _ROWS):
        png.rows(np.ascontiguousarray(rows[: frame.height - top]))
    return {_NAME: png}


def with_paper(root: StackEntry, paper: str | None) -> StackEntry:
    """Returns the layers as other programs are told them, on a paper."""
    if paper is None:
        return root
    return replace(root, children=(*root.children, LayerEntry(_NAME, "Paper", locked=True, ours={"paper": paper})))
