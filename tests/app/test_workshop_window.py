"""The workshop in the real window: a texture is written, a mistake told where it is, the brush paints with it, and it
is changed as nodes."""

from contextlib import suppress

import numpy as np
import pytest

pytestmark = pytest.mark.window

TEXT = "ramp(noise(x*3, y*3), #ff1000, #0010ff)"
LINE = [(320 + 20 * i, 120 + (20 if i % 6 < 3 else -20)) for i in range(30)]


def coloured(pixels):
    """Tells whether a good part is red, and a good part blue."""
    red, blue = pixels[..., 0].astype(int), pixels[..., 2].astype(int)
    return min((red - blue > 60).mean(), (blue - red > 60).mean()) > 0.02


def test_a_texture_is_written_and_painted_with(program):
    app = program()
    app.keys("shift+e")
    seen = app.part("looked at")
    app.until(lambda screen: screen[seen].std() > 5)
    _, top, right, bottom = app.box("line 1")
    app.click((right + 60, (top + bottom) // 2))
    app.keys("ctrl+a")
    app.type(f"{TEXT} +")
    app.box("mistake")
    kept = app.screen()[seen]
    assert kept.std() > 5, "the last good picture stays"
    app.keys("BackSpace", "BackSpace")
    for _ in range(4):  # a key may be lost on a busy machine
        with suppress(AssertionError):
            app.until_gone("mistake", 15.0)
        if "mistake" not in {name for _, name in app.boxes()}:
            break
        app.keys("ctrl+a")
        app.type(TEXT)
    app.until_gone("mistake")
    app.until(lambda screen: coloured(screen[seen]))

    app.click("Use as ink")
    before = app.canvas()[:280]  # above the workshop
    app.stroke(*LINE)

    def painted(screen):
        now = screen[60:340, 270:970].astype(int)
        changed = np.abs(now - before).max(axis=-1) > 30
        return changed.sum() > 1000 and coloured(now[changed][None])

    app.until(painted)
    changed_as_nodes(app, seen)


def changed_as_nodes(app, seen):
    """A number dragged in a node is another one in the text, and one step of its undo."""
    before = app.parked()[seen]
    app.click("as nodes")
    x, y = app.at("texture a 5")  # of noise(x*3
    app.drag((x, y), (x + 80, y))
    app.do("mouseup", 1)
    app.until(lambda screen: np.abs(screen[seen] - before).mean() > 5)
    app.click("text back")
    app.until(lambda screen: np.abs(screen[seen] - before).mean() < 1)
