"""Where the nodes of a text lie at first: in columns, each to the right of all that it is made of."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from imgui_bundle import ImVec2

from app.desk.workshop.text_nodes import LineNode, NodeRow, Piece, Slot, TextNodes

ROW_WIDE = 17.0  # letters' sizes: what is longer goes on below
NUMBER_WIDE, COLOUR_WIDE, PIN_WIDE = 3.4, 1.7, 0.7
_LETTER, _LABEL = 0.52, 0.3  # of a letter's width and height, and between two pieces
_TITLE, _ROW = 3.2, 2.0  # high
_ACROSS, _DOWN = 3.5, 1.0  # between columns, and nodes


class NodeAt(NamedTuple):
    """The corner of a node, in letters' sizes."""

    x: float
    y: float


def piece_width(piece: Piece) -> float:
    """Returns about how wide a piece of a row is drawn."""
    if isinstance(piece, str):
        return len(piece) * _LETTER + _LABEL
    wide = {"number": NUMBER_WIDE, "colour": COLOUR_WIDE}.get(piece.kind, len(piece.text) * _LETTER)
    return wide + _LABEL + (0.0 if piece.set_ else PIN_WIDE)


def broken_rows(row: NodeRow) -> list[list[Piece]]:
    """Returns the pieces of a row, in as many as they need."""
    out: list[list[Piece]] = [[]]
    left = ROW_WIDE - (len(row.label) * _LETTER + _LABEL if row.label else 0.0)
    for piece in row.pieces:
        wide = piece_width(piece)
        if wide > left and out[-1]:
            out.append([])
            left = ROW_WIDE
        out[-1].append(piece)
        left -= wide
    return out


def first_places(found: TextNodes) -> dict[str, NodeAt]:
    """Returns where each node lies, by its name."""
    columns = found.columns()
    wide = [0.0] * (max(columns) + 1)
    for node, column in zip(found.nodes, columns, strict=True):
        wide[column] = max(wide[column], node_width(node))
    tall = [-_DOWN] * len(wide)
    for node, column in zip(found.nodes, columns, strict=True):
        tall[column] += _height(node) + _DOWN
    tops = [(max(tall) - one) / 2 for one in tall]
    out = {}
    for node, column in zip(found.nodes, columns, strict=True):
        out[node.name] = NodeAt(sum(wide[:column]) + column * _ACROSS, tops[column])
        tops[column] += _height(node) + _DOWN
    return out


def node_width(node: LineNode) -> float:
    """Returns about how wide a node is drawn, in letters' sizes."""
    rows = [sum(map(piece_width, part)) for row in node.rows for part in broken_rows(row)]
    labels = max((len(row.label) for row in node.rows), default=0) * _LETTER
    return max((len(node.name) + len(node.head)) * _LETTER + 4.0, labels + max(rows, default=0.0)) + 1.2


def _height(node: LineNode) -> float:
    return _TITLE + _ROW * sum(len(broken_rows(row)) for row in node.rows)


def slots_of(found: TextNodes) -> list[tuple[LineNode, Slot, tuple[str, int, int]]]:
    """Returns all that can be set, with its node and what tells it from others: the line, row and piece."""
    return [
        (node, piece, (node.name, n, m))
        for node in found.nodes
        for n, row in enumerate(node.rows)
        for m, piece in enumerate(row.pieces)
        if isinstance(piece, Slot)
    ]


def legible(boxes: Sequence[tuple[ImVec2, ImVec2]], room: ImVec2) -> tuple[int, ...]:
    """Returns which nodes, corners and ends, fit into a room together: the last one, and those nearest to the left."""
    corner, end = boxes[-1]
    shown = [len(boxes) - 1]
    for n in sorted(range(len(boxes) - 1), key=lambda n: -boxes[n][1].x):
        low, high = _least(corner, boxes[n][0]), _most(end, boxes[n][1])
        if high.x - low.x > room.x or high.y - low.y > room.y:
            break
        corner, end = low, high
        shown.append(n)
    return tuple(shown)


def _least(a: ImVec2, b: ImVec2) -> ImVec2:
    return ImVec2(min(a.x, b.x), min(a.y, b.y))


def _most(a: ImVec2, b: ImVec2) -> ImVec2:
    return ImVec2(max(a.x, b.x), max(a.y, b.y))
