"""Matching in the real window: what is in view is an example, the texture like it is painted with."""

import numpy as np
import pytest
from screens import changed

pytestmark = [pytest.mark.window, pytest.mark.timeout(240)]

POINTER = (640, 790)  # where it covers nothing that is looked at
EXAMPLE, SECOND = (slice(465, 570), slice(270, 400)), (slice(615, 720), slice(265, 405))
TEXTURE = (slice(465, 730), slice(425, 670))
MIXER, CANVAS = (slice(365, 420), slice(1005, 1135)), (slice(60, 400), slice(280, 960))
VIEW, DICE, SECOND_AREA, USE = (294, 592), (666, 752), (320, 745), (752, 755)
LINE = [(300 + 20 * i, 120 + (25 if i % 6 < 3 else -25)) for i in range(30)]


def test_a_texture_like_the_view_is_ink(program):
    app = program()
    app.do("mousemove", 700, 60)
    app.settled()
    app.keys(*["bracketright"] * 20)
    app.stroke(*[(x, y + 200) for x, y in LINE])
    app.keys("t")  # what was in the middle stays there: the stroke is 200 pixels higher
    opened = app.parked(POINTER)
    app.click(VIEW)
    matched = app.until(lambda screen: screen[TEXTURE].std() > 6 and screen[EXAMPLE].std() > 6, POINTER)
    assert changed(matched[SECOND], opened[SECOND]) < 50

    # Another seed, another texture.
    app.click(DICE)
    thrown = app.until(lambda screen: changed(screen[TEXTURE], matched[TEXTURE]) > 500, POINTER)

    # A rectangle marked on the canvas is the second example; the two are mixed.
    app.click(SECOND_AREA)
    app.parked(POINTER)
    app.stroke((340, 90), (400, 110), (520, 150))
    mixed = app.until(lambda screen: screen[SECOND].std() > 6, POINTER)
    assert changed(mixed[CANVAS], thrown[CANVAS]) < 50  # nothing was painted

    # Used as ink, it is painted with.
    app.click(USE)
    app.until(lambda screen: changed(screen[MIXER], mixed[MIXER]) > 300, POINTER)
    app.stroke(*[(x, y + 180) for x, y in LINE])
    stroke = (slice(280, 320), slice(320, 860))
    painted = app.until(lambda screen: changed(screen[stroke], mixed[stroke]) > 3000, POINTER)
    core = painted[298:302, 400:800].reshape(-1, 3)
    assert len(np.unique(core, axis=0)) > 40  # plain paint is even
    app.keys("t")
    app.until(lambda screen: changed(screen[TEXTURE], painted[TEXTURE]) > 3000, POINTER)
