"""A picture that goes on below its own pixels, in the real window."""

import numpy as np
import pytest
from dragging import Drag
from PIL import Image
from test_dropping_window import until, window_of

pytestmark = pytest.mark.window


@pytest.fixture
def stones(tmp_path):
    """Round stones of several greys."""
    random, (y, x) = np.random.default_rng(2), np.mgrid[:160, :200]
    pixels = np.full((160, 200), 60.0) + 8 * random.standard_normal((160, 200))
    for _ in range(260):
        v, u, r = random.uniform(0, 160), random.uniform(0, 200), random.uniform(4, 12)
        edge = np.clip(r - np.hypot(y - v, x - u), 0.0, 1.0)
        shade = random.uniform(110, 230) * (0.8 + 0.3 * np.clip((v - y) / r, -1, 1)) + 5 * random.standard_normal(
            x.shape
        )
        pixels += (shade - pixels) * edge
    path = tmp_path / "stones.png"
    Image.fromarray(np.clip(pixels, 0, 255).astype(np.uint8)).save(path)
    return path


def edges(screen):
    inner = screen[330:470, 420:600].mean(axis=2)
    return float(np.abs(np.diff(inner, axis=1)).max(axis=1).mean())


@pytest.mark.nightly
def test_a_layer_is_extrapolated_where_one_looks_closer(program, stones):
    found = []
    for refined in (False, True):
        app = program()
        app.settled()
        app.do("mousemove", 510, 400)
        Drag(app.display, window_of(app), stones).drop(510, 400)
        if refined:
            app.click("Extrapolate")
        app.click("Layer")
        until(lambda app=app: app.screen()[330:470, 420:600].std() > 10)
        app.keys("b")
        for _ in range(5):
            app.do("mousemove", 510, 400, "click", 4)
        app.settled()
        until(lambda app=app: len(np.unique(app.screen()[330:470, 420:600].reshape(-1, 3), axis=0)) > 20)
        app.settled()
        found.append(edges(app.screen()))
    assert found[1] > 1.2 * found[0]


@pytest.mark.nightly
def test_a_picture_as_ink_has_a_slider_for_its_detail(program, stones):
    app = program()
    app.settled()
    Drag(app.display, window_of(app), stones).drop(510, 400)
    app.click("Texture")
    until(lambda: 'box ["ink", "stones"' in app.log.read_text())
    app.settled()
    row = app.box("stones")
    app.do("mousemove", round(row[2] + 48), round((row[1] + row[3]) / 2), "click", 1)
    until(lambda: 'box ["", "Detail"' in app.log.read_text())
