"""Matching in the real window: what is in view is an example, the texture like it is painted with."""

import numpy as np
import pytest
from screens import changed

pytestmark = pytest.mark.window

CANVAS = (slice(60, 400), slice(280, 960))
LINE = [(300 + 20 * i, 120 + (25 if i % 6 < 3 else -25)) for i in range(30)]


@pytest.mark.nightly
def test_a_texture_like_the_view_is_ink(program):
    app = program()
    app.settled()
    app.keys(*["bracketright"] * 20)
    app.stroke(*[(x, y + 200) for x, y in LINE])
    app.keys("t")  # what was in the middle stays there: the stroke is 200 pixels higher
    example, second, texture = (app.part(name) for name in ("example", "example 2", "texture"))
    opened = app.parked()
    app.click("view")
    matched = app.until(lambda screen: screen[texture].std() > 6 and screen[example].std() > 6)
    assert changed(matched[second], opened[second]) < 50

    # Another seed, another texture.
    app.click("throw")
    thrown = app.until(lambda screen: changed(screen[texture], matched[texture]) > 500)

    # A rectangle marked on the canvas is the second example; the two are mixed.
    app.click("area 2")
    app.parked()
    app.stroke((340, 90), (400, 110), (520, 150))
    mixed = app.until(lambda screen: screen[second].std() > 6)
    assert changed(mixed[CANVAS], thrown[CANVAS]) < 50  # nothing was painted

    # Used as ink, it is painted with.
    mixer = slice(app.box("Ink mixer")[3], app.box("below ink")[1]), slice(*app.box("Ink mixer")[::2])
    app.click("Use as ink")
    app.until(lambda screen: changed(screen[mixer], mixed[mixer]) > 300)
    app.stroke(*[(x, y + 180) for x, y in LINE])
    stroke = (slice(280, 320), slice(320, 860))
    painted = app.until(lambda screen: changed(screen[stroke], mixed[stroke]) > 3000)
    core = painted[298:302, 400:800].reshape(-1, 3)
    assert len(np.unique(core, axis=0)) > 40  # plain paint is even
    app.keys("t")
    app.until(lambda screen: changed(screen[texture], painted[texture]) > 3000)
