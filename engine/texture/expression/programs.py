"""A written texture at a level as a program of the machine, and what that gives over a rectangle."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from engine.numeric.address import Rect
from engine.texture.expression import machine
from engine.texture.expression.codes import Code
from engine.texture.expression.graph import Graph, Operation, needed_by
from engine.texture.expression.noise_rows import ROOM
from engine.texture.expression.weaving import Woven

WRAP = 65536  # periods, after which a texture begins anew
_EXACT = 1 << 50  # samples that floats count


@dataclass(frozen=True, eq=False, slots=True)
class Program:
    """What `machine.run` takes; `constants` fill the first registers; `side`: samples along a pixel; `whole`, `takes`:
    as `Woven` has them."""

    steps: np.ndarray
    numbers: np.ndarray
    keys: np.ndarray
    constants: np.ndarray
    registers: int
    shown: np.ndarray
    side: int
    cost: float
    whole: object | None = None
    takes: tuple[int, ...] = ()

    @property
    def channels(self) -> int:
        """Gives how many planes it makes: one of a number, four of a colour."""
        return self.shown.size

    def over(self, xs: np.ndarray, ys: np.ndarray, pictures: np.ndarray | None = None) -> np.ndarray:
        """Returns the means over pixels: float32 (channels, h, w); `xs`, `ys` are the places of the samples."""
        out = np.zeros((self.channels, ys.size // self.side, xs.size // self.side), np.float32)
        registers = np.zeros((self.registers, machine.LENGTH))
        registers[: self.constants.size] = self.constants[:, None]
        if pictures is None:
            pictures = np.zeros((1, ys.size, xs.size)) if _looks(self.steps) else _NONE
        room = np.empty((5, ROOM, machine.LENGTH))
        machine.run(self.steps, self.numbers, self.keys, xs, ys, self.shown, pictures, registers, room, out)
        return out


_COLUMNS = 12
_NONE = np.zeros((1, 1, 1))


def _looks(steps: np.ndarray) -> bool:
    return bool((steps[:, 0] == Code.PICTURE).any())


def program(woven: Woven, side: int) -> Program:
    """Returns the program that works out what was woven, with so many samples along a pixel."""
    graph, shown = woven.graph, woven.value.nodes
    needed = needed_by(graph, shown)
    fixed = [node for node in needed if graph.operations[node].code == Code.CONST]
    rows = {node: n for n, node in enumerate(fixed)}
    numbers: list[float] = []
    keys: list[int] = []
    free: list[int] = []
    last = _last_uses(graph, needed, shown)
    count, steps, constant = len(fixed), [], set(fixed)
    kin = _kin(graph, needed)

    def room() -> int:
        nonlocal count
        if free:
            return free.pop()
        count += 1
        return count - 1

    for node in needed:
        told = graph.operations[node]
        if node not in rows:
            alike = kin.get(node, (node,))
            made = [room() for _ in alike]
            step = _step(told, made[0], [rows[part] for part in told.parts], len(numbers), len(keys))
            if len(made) > 1:
                step[-1] = machine.WITH_SLOPES
            steps.append([*step, *made[1:], 0, 0][:_COLUMNS])
            numbers += told.numbers
            keys += told.key
            rows |= {one: row for one, row in zip(alike, made, strict=True) if one >= 0}
            free += [row for one, row in zip(alike, made, strict=True) if one < 0]
        free += [rows[part] for part in set(told.parts) if last[part] == node and part not in constant]
    constants = np.array([graph.value(node) for node in fixed], np.float64)
    return Program(
        np.array(steps, np.int32).reshape(-1, _COLUMNS), np.array([*numbers, 0.0]), np.array([*keys, 0], np.uint32),
        constants, max(count, 1), np.array([rows[node] for node in shown], np.int32), side, woven.cost,
        woven.whole, woven.takes,
    )  # fmt: skip


def _kin(graph: Graph, needed: Iterable[int]) -> dict[int, tuple[int, int, int]]:
    """Returns for each noise whose slopes are needed the nodes of its value and of both, -1 where one is not."""
    found: dict[tuple[object, ...], list[int]] = {}
    for node in needed:
        told = graph.operations[node]
        if told.code == Code.NOISE:
            found.setdefault((told.parts, told.numbers, told.key), [-1, -1, -1])[told.slope] = node
    return {node: (a, b, c) for a, b, c in found.values() if (b, c) != (-1, -1) for node in (a, b, c) if node >= 0}


def _last_uses(graph: Graph, needed: Iterable[int], shown: Iterable[int]) -> dict[int, int]:
    last = {part: node for node in needed for part in graph.operations[node].parts}
    return last | dict.fromkeys(shown, -1)


def _step(told: Operation, row: int, parts: list[int], number: int, key: int) -> list[int]:
    count = told.kind
    if told.code == Code.NOISE:
        count = len(told.key)
    elif told.code == Code.RAMP:
        count = len(told.numbers) // 2
    return [told.code, row, *(*parts, 0, 0, 0, 0)[:4], number, key, count, told.slope]


def sample_places(first: int, count: int, side: int, period: Fraction) -> np.ndarray:
    """Returns where the samples of `count` pixels lie, in periods within WRAP / 2 of 0: float64 (count side,).

    Each by its place alone, whatever else is asked for.
    """
    start, size = first * side, count * side
    whole = Fraction(side) * period
    turns = {_turn(start, whole), _turn(start + size - 1, whole)}
    if turns == {0} and abs(start) + size < _EXACT:
        return (np.arange(start, start + size) + 0.5) / float(whole)
    return np.array([_far(n, whole) for n in range(start, start + size)])


def _turn(sample: int, whole: Fraction) -> int:
    return int((Fraction(2 * sample + 1, 2) / whole + WRAP // 2) // WRAP)


def _far(sample: int, whole: Fraction) -> float:
    return float(Fraction(2 * sample + 1, 2) / whole - WRAP * _turn(sample, whole))


def make_kernels() -> None:
    """Runs the machine once, on nothing, so that its kernels are there."""
    numbers, keys = np.zeros(1), np.zeros(1, np.uint32)
    empty = Program(np.zeros((0, 10), np.int32), numbers, keys, np.ones(1), 1, np.zeros(1, np.int32), 1, 0.0)
    empty.over(np.zeros(1), np.zeros(1))


def draw_program(made: Program, rect: Rect, period: Fraction, pictures: np.ndarray | None = None) -> np.ndarray:
    """Returns a program's means over the pixels of a rectangle: float32 (channels, h, w); `period`: pixels."""
    xs = sample_places(rect.x0, rect.width, made.side, period)
    ys = sample_places(rect.y0, rect.height, made.side, period)
    return made.over(xs, ys, pictures)
