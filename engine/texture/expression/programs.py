"""A written texture at a level as a program of the machine, and what that gives over a rectangle."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from engine.numeric.address import Rect
from engine.texture.expression import machine
from engine.texture.expression.codes import Code
from engine.texture.expression.graph import Graph, Operation, needed_by
from engine.texture.expression.naming.asking import AskedPlace, AskedTexture, asked_of, place_asked
from engine.texture.expression.noise_rows import ROOM
from engine.texture.expression.sampling.errors import FEW_FROM, JUMP_SIDE, MANY_FROM, POINT_SIDE
from engine.texture.expression.sampling.sample_trial import far_apart
from engine.texture.expression.weaving import Woven

WRAP = 65536  # periods, after which a texture begins anew
_EXACT = 1 << 50  # samples that floats count


@dataclass(frozen=True, eq=False, slots=True)
class Program:
    """What `machine.run` takes; `constants` fill the first registers; `side`: samples along a pixel; `whole`, `takes`:
    as `Woven` has them.

    Where `finer` is told, the last plane is the error of a pixel, and finer(side) the program for those pixels that
    take more samples, `most` along each at most; where it `compares`, all take four, and those more in which these are
    far from one.  `asks`: what it asks of textures of other makers, each with the program of the places.  `fit`: what
    pixels are multiplied by, and what is added, (2, channels, 1), where there is that.
    """

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
    finer: Callable[[int], Program] | None = None
    compares: bool = False
    most: int = JUMP_SIDE
    asks: tuple[tuple[AskedTexture, Program], ...] = ()
    fit: np.ndarray | None = None

    @property
    def channels(self) -> int:
        """Gives how many planes it makes: one of a number, four of a colour."""
        return self.shown.size - (self.finer is not None)

    def over(self, xs: np.ndarray, ys: np.ndarray, row: int, pictures: np.ndarray | None = None) -> np.ndarray:
        """Returns the means over pixels, float32 (planes, pixels); `xs`, `ys`: the places of their samples, (samples of
        a pixel, pixels); `row`: pixels in a row; `pictures` that it takes, (n, samples of a pixel, pixels)."""
        if self.asks and xs.shape[1] > _AT_ONCE:
            parts = [slice(n, n + _AT_ONCE) for n in range(0, xs.shape[1], _AT_ONCE)]
            cut = [(np.ascontiguousarray(xs[:, part]), np.ascontiguousarray(ys[:, part])) for part in parts]
            return np.concatenate([self.over(across, down, _AT_ONCE) for across, down in cut], axis=1)
        out = np.zeros((self.shown.size, xs.shape[1]), np.float32)
        if self.asks:
            pictures = _answers(self.asks, xs.reshape(-1), ys.reshape(-1)).reshape(-1, *xs.shape)
        elif pictures is None:
            pictures = np.zeros((1, *xs.shape)) if _looks(self.steps) else _NOTHING
        self._run(xs, ys, row, self.shown, pictures, self._registers(), out)
        return out

    def values(self, xs: np.ndarray, ys: np.ndarray, pictures: np.ndarray) -> np.ndarray:
        """Returns what it shows at samples as it is, neither bounded nor rounded: float64 (shown, n); `pictures`:
        (n, 1, samples)."""
        out, registers = np.empty((self.shown.size, xs.size)), self._registers()
        looks, nothing = _looks(self.steps), np.zeros(0, np.int32)
        for start in range(0, xs.size, machine.LENGTH):
            part = slice(start, min(start + machine.LENGTH, xs.size))
            size = part.stop - start
            seen = np.ascontiguousarray(pictures[:, :, part]) if looks else _NOTHING
            places = xs[None, part], ys[None, part]
            self._run(*places, size, nothing, seen, registers, np.zeros((0, size), np.float32))
            out[:, part] = registers[self.shown, :size]
        return out

    def _registers(self) -> np.ndarray:
        registers = np.zeros((self.registers, machine.LENGTH))
        registers[: self.constants.size] = self.constants[:, None]
        return registers

    def _run(
        self, xs: np.ndarray, ys: np.ndarray, row: int, shown: np.ndarray, pictures: np.ndarray, registers: np.ndarray,
        out: np.ndarray,
    ) -> None:  # fmt: skip
        room = np.empty((5, ROOM, machine.LENGTH))
        machine.run(self.steps, self.numbers, self.keys, xs, ys, row, shown, pictures, registers, room, out)


def _answers(asks: tuple[tuple[AskedTexture, Program], ...], xs: np.ndarray, ys: np.ndarray) -> np.ndarray:
    """Returns the pictures that hold what textures of other makers show at samples: float64 (planes, n)."""
    last = asks[-1][0]
    pictures = np.zeros((last.plane + last.planes, xs.size))
    for asked, places in asks:
        answer = asked.answer(*places.values(xs, ys, pictures[:, None]))
        pictures[asked.plane : asked.plane + len(answer)] = answer
    return pictures


_AT_ONCE = 1 << 12  # pixels, where there are pictures for each of their samples
_COLUMNS, _COUNT = 12, 8
_BOUNDS = np.float32(-1.0), np.float32(2.0)  # as the machine has them
_NOTHING = np.zeros((1, 1, 1))


def _looks(steps: np.ndarray) -> bool:
    return bool((steps[:, 0] == Code.PICTURE).any())


def program(woven: Woven, side: int, finer: Callable[[int], Program] | None = None, compares: bool = False) -> Program:
    """Returns the program that works out what was woven, with so many samples along a pixel, and its error where
    `finer` is told."""
    graph, shown = woven.graph, (*woven.value.nodes, woven.value.error)[: None if finer else -1]
    asked = asked_of(graph, needed_by(graph, shown), len(woven.takes))
    made = replace(
        _assembled(graph, shown, asked), side=side, cost=woven.cost * side**2, whole=woven.whole, takes=woven.takes,
        finer=finer, compares=compares,
    )  # fmt: skip
    return replace(made, asks=tuple((one, _assembled(graph, one.parts, asked)) for one in asked.values()))


def _assembled(graph: Graph, shown: tuple[int, ...], asked: Mapping[AskedPlace, AskedTexture]) -> Program:
    """Returns the program of some nodes, those of textures of other makers being there already."""
    needed = _needed(graph, shown)
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
            step = _step(told, made[0], [rows[part] for part in _parts(told)], len(numbers), len(keys))
            if told.code == Code.PICTURE and told.parts:
                step[_COUNT] = asked[place_asked(told)].picture(told)
            if len(made) > 1:
                step[-1] = machine.WITH_SLOPES
            steps.append([*step, *made[1:], 0, 0][:_COLUMNS])
            numbers += told.numbers
            keys += told.key
            rows |= {one: row for one, row in zip(alike, made, strict=True) if one >= 0}
            free += [row for one, row in zip(alike, made, strict=True) if one < 0]
        free += [rows[part] for part in set(_parts(told)) if last[part] == node and part not in constant]
    return Program(
        np.array(steps, np.int32).reshape(-1, _COLUMNS), np.array([*numbers, 0.0]), np.array([*keys, 0], np.uint32),
        np.array([graph.value(node) for node in fixed], np.float64), max(count, 1),
        np.array([rows[node] for node in shown], np.int32), 1, 0.0,
    )  # fmt: skip


def _needed(graph: Graph, nodes: Iterable[int]) -> list[int]:
    """Returns what nodes need, as `needed_by`, but nothing of places at which other textures are asked for."""
    found, open_ = set(), list(nodes)
    while open_:
        node = open_.pop()
        if node not in found:
            found.add(node)
            open_.extend(_parts(graph.operations[node]))
    return sorted(found)


def _parts(told: Operation) -> tuple[int, ...]:
    return () if told.code == Code.PICTURE else told.parts


def _kin(graph: Graph, needed: Iterable[int]) -> dict[int, tuple[int, int, int]]:
    """Returns for each noise whose slopes are needed the nodes of its value and of both, -1 where one is not."""
    found: dict[tuple[object, ...], list[int]] = {}
    for node in needed:
        told = graph.operations[node]
        if told.code == Code.NOISE:
            found.setdefault((told.parts, told.numbers, told.key), [-1, -1, -1])[told.slope] = node
    return {node: (a, b, c) for a, b, c in found.values() if (b, c) != (-1, -1) for node in (a, b, c) if node >= 0}


def _last_uses(graph: Graph, needed: Iterable[int], shown: Iterable[int]) -> dict[int, int]:
    last = {part: node for node in needed for part in _parts(graph.operations[node])}
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
    empty.over(np.zeros((1, 1)), np.zeros((1, 1)), 1)


def draw_program(made: Program, rect: Rect, period: Fraction) -> np.ndarray:
    """Returns a program's means over the pixels of a rectangle: float32 (channels, h, w); `period`: pixels."""
    rows, columns = np.divmod(np.arange(rect.area), max(rect.width, 1))

    def samples(side: int, which: np.ndarray | None = None) -> _Samples:
        xs = sample_places(rect.x0, rect.width, side, period).reshape(rect.width, side)
        ys = sample_places(rect.y0, rect.height, side, period).reshape(rect.height, side)
        some = (columns, rows) if which is None else (columns[which], rows[which])
        return _meshed(xs[some[0]], ys[some[1]])

    return _fitted(made, _drawn(made, samples, max(rect.width, 1))).reshape(-1, rect.height, rect.width)


def draw_pixels(made: Program, columns: np.ndarray, rows: np.ndarray, period: Fraction) -> np.ndarray:
    """Returns a program's means over some pixels: float32 (channels, pixels)."""

    def samples(side: int, which: np.ndarray | None = None) -> _Samples:
        along = (np.arange(side) + 0.5) / side
        some = (columns, rows) if which is None else (columns[which], rows[which])
        xs, ys = ((one[:, None] + along) / float(period) for one in some)
        return _meshed(xs, ys)

    return _fitted(made, _drawn(made, samples, columns.size))


_Samples = tuple[np.ndarray, np.ndarray]


def _meshed(xs: np.ndarray, ys: np.ndarray) -> _Samples:
    """Returns the places of the samples of pixels: each float64 (side side, pixels); `xs`, `ys`: (pixels, side)."""
    side = xs.shape[1]
    right, below = np.tile(np.arange(side), side), np.repeat(np.arange(side), side)
    return np.ascontiguousarray(xs.T[right]), np.ascontiguousarray(ys.T[below])


def _drawn(made: Program, samples: Callable[..., _Samples], row: int) -> np.ndarray:
    """Returns the means over pixels, each with as many samples as it takes; `row`: pixels in a row."""
    out = made.over(*samples(made.side), row)
    if made.finer is None:
        return out
    error, out = out[-1], out[:-1]
    if made.compares:
        plain, out = out, made.finer(POINT_SIDE).over(*samples(POINT_SIDE), row)
        error[far_apart(plain, out)] = 1.0
    few, many = (error >= np.float32(least) for least in (FEW_FROM, MANY_FROM))
    if made.side > 1 or made.compares:
        few = many
    for side, which in ((POINT_SIDE, np.flatnonzero(few & ~many)), (JUMP_SIDE, np.flatnonzero(many))):
        if which.size:
            side = min(side, made.most)
            out[:, which] = made.finer(side).over(*samples(side, which), which.size)
    return out


def _fitted(made: Program, out: np.ndarray) -> np.ndarray:
    return out if made.fit is None else np.clip(out * made.fit[0] + made.fit[1], *_BOUNDS)
