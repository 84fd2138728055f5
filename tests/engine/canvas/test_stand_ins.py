"""What stands in for kernels that are not compiled gives the same bits."""

import numpy as np
import pytest

from engine.brush.settings import Brush, Component
from engine.canvas import kernels
from engine.canvas.composite import composite
from engine.canvas.dither import NO_DITHER
from engine.canvas.front import blank_marks
from engine.canvas.reading import layer_planes
from engine.canvas.rising import counting
from engine.kernel_cache import NotCompiled
from engine.numeric import stand_in
from engine.numeric.address import Rect
from engine.numeric.colour import to_premul8
from engine.numeric.grid import FINE_STEP
from engine.numeric.stand_in import Kernel, or_interpreted, or_plain
from engine.painting.value import Painting
from engine.strokes.paint_stroke import LiveStroke
from engine.texture.rock import Rock

STROKES = (
    Brush(radius=12.0),
    Brush(radius=90.0, hardness=0.2, opacity=0.6, flow=0.3, spacing=0.2, colour="#c86428"),
    Brush(radius=5.0, hardness=1.0, colour="#10c0f0"),
    Brush(radius=30.0, mode="erase", opacity=0.7),
)

_NO_COLOUR = np.empty(0, np.float32)


@pytest.fixture
def nothing_compiled(monkeypatch):
    """Kernels that can do without being compiled are never found; the names of the plain forms called."""
    called = set()

    def call(kernel, *arguments):
        called.add(kernel.compiled.py_func.__name__)
        return kernel.plain(*arguments)

    monkeypatch.setattr(Kernel, "__call__", call)
    return called


def painted():
    """Pictures of four strokes that cross, as they grow and when they are done."""
    painting, seen = Painting(), []
    t = np.linspace(0.0, 1.0, 12)
    for number, brush in enumerate(STROKES):
        live = LiveStroke(painting, -number % 2, (7, -3), brush)
        for k in range(4):
            part = t[3 * k : 3 * k + 3]
            live.add(np.column_stack([40 + 260 * part, 60 + 30 * number + 90 * part * part, 0.2 + 0.8 * part]))
            seen.append(live.preview(Rect(0, 0, 256, 256)).data.copy())
        painting = live.commit()
    for level in (-2, 0, 1):
        picture = composite(painting.root, level, Rect(-20, -20, 300, 280), layer_planes)
        seen += [picture, to_premul8(picture)]
    return seen


def test_plain_strokes_are_the_same_bits(request):
    compiled = painted()
    called = request.getfixturevalue("nothing_compiled")
    plain = painted()
    assert {"walk_points", "as_discs", "list_pairs", "_join", "lay_flat", "lay"} <= called
    assert {"keep_of", "apply_stamp", "place", "expand_into"} <= called
    assert {"climb", "lower", "spread", "boxes", "renew", "edges"} <= called
    for one, other in zip(compiled, plain, strict=True):
        assert one.dtype == other.dtype
        assert np.array_equal(one, other)


def test_extents_of_nothing():
    for keep in (np.ones((6, 9), np.float32), 1.0 - np.eye(6, 9, 2, dtype=np.float32)):
        old, new, marks = np.ones((4, 6, 9), np.float32), np.empty((4, 6, 9), np.float32), blank_marks(6, 9)
        arguments = (
            old,
            keep,
            np.zeros_like(old),
            _NO_COLOUR,
            np.arange(4),
            True,
            False,
            new,
            marks,
            FINE_STEP,
            NO_DITHER,
        )
        assert kernels.apply_stamp.compiled(*arguments) == kernels.apply_stamp.plain(*arguments)
    for data in (np.zeros((2, 5, 7), np.int32), np.arange(-35, 35, dtype=np.int32).reshape(2, 5, 7)):
        used = np.empty((2, 2), np.int32)
        assert counting.extent.compiled(data, used[0]) == counting.extent.plain(data, used[1])
        assert np.array_equal(used[0], used[1])


def test_where_ink_lies_in_some_rows():
    rng = np.random.default_rng(3)
    for share in (0.0, 0.002, 0.01, 0.1, 1.0):
        for _ in range(20):
            data = np.where(rng.random((9, 12, 31)) < share, 1.5, rng.choice([0.0, -0.0])).astype(np.float32)
            first, last = sorted(rng.integers(0, 13, 2).tolist())
            found = kernels.extent_in_rows.plain(data, 4, 7, first, last)
            assert kernels.extent_in_rows.compiled(data, 4, 7, first, last) == found
            ys, xs = np.nonzero(data[4:7, first:last].any(axis=0))
            expected = (first + ys.min(), first + ys.max() + 1, xs.min(), xs.max() + 1) if ys.size else (0, 0, 0, 0)
            assert found == expected


def test_a_texture_is_worked_out_only_where_its_ink_lies(monkeypatch):
    asked, bandpass = [], Rock.bandpass

    def noted(rock, level, rect):
        asked.append(rect)
        return bandpass(rock, level, rect)

    monkeypatch.setattr(Rock, "bandpass", noted)
    live = LiveStroke(Painting(), 0, (0, 0), Brush(radius=6.0, hardness=1.0, ink=(Component("rock", 0.6, "#d0b090"),)))
    live.add(np.array([[100.0, 100.0, 1.0], [140.0, 112.0, 1.0]]))
    painting = live.commit()
    asked.clear()
    whole = composite(painting.root, 2, Rect(0, 0, 1024, 1024), layer_planes)
    assert 0 < sum(rect.area for rect in asked) < 1024 * 32  # two levels of some 60 x 30 pixels of level 0
    part = Rect(390, 380, 602, 490)
    assert np.array_equal(composite(painting.root, 2, part, layer_planes), whole[:, 380:490, 390:602])


def test_a_kernel_is_looked_for_again_after_a_while(monkeypatch):
    now, missing = [100.0], [True]
    monkeypatch.setattr(stand_in.time, "monotonic", lambda: now[0])
    asked = []

    def compiled(value):
        asked.append(value)
        if missing[0]:
            raise NotCompiled("it")
        return "compiled"

    kernel = or_plain(lambda value: "plain")(compiled)
    assert [kernel(1), kernel(2)] == ["plain", "plain"]
    assert asked == [1]
    missing[0] = False
    assert kernel(3) == "plain"
    now[0] += stand_in.REST
    assert [kernel(4), kernel(5)] == ["compiled", "compiled"]
    assert asked == [1, 4, 5]


def test_the_text_of_a_kernel_is_interpreted_with_those_it_calls():
    from engine.brush import discs

    kernel = or_interpreted()(discs.lay_flat.compiled)
    rows = np.array([[0.0, 0.0, 9.0, 1.0, 0.1, 0.75, 0.5]] * 3)
    told = kernel.plain(rows, np.arange(3), np.array([True, True, False]), np.float32(0.25), 0.75)
    assert told == discs.lay_flat.compiled(rows, np.arange(3), np.array([True, True, False]), np.float32(0.25), 0.75)
