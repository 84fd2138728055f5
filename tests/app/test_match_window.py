"""Matching in the real window: what is in view is an example, the texture like it is painted with."""

import time

import numpy as np
import pytest

pytestmark = [pytest.mark.window, pytest.mark.timeout(240)]

EXAMPLE, SECOND = (slice(465, 570), slice(270, 400)), (slice(615, 720), slice(265, 405))
TEXTURE = (slice(465, 730), slice(425, 670))
MIXER, CANVAS = (slice(365, 420), slice(1005, 1135)), (slice(60, 400), slice(280, 960))
VIEW, DICE, SECOND_AREA, USE = (294, 592), (666, 752), (320, 745), (752, 755)
LINE = [(300 + 20 * i, 120 + (25 if i % 6 < 3 else -25)) for i in range(30)]


def parked(app):
    app.do("mousemove", 640, 790)
    time.sleep(0.3)
    return app.settled(calm=2).astype(int)


def until(app, good, seconds=60.0):
    end = time.monotonic() + seconds
    while not good(screen := parked(app)):
        assert time.monotonic() < end
    return screen


def click(app, at):
    app.do("mousemove", *at)
    time.sleep(0.25)
    app.do("click", 1)


def changed(a, b):
    return int((np.abs(a - b).max(axis=-1) > 12).sum())


def test_a_texture_like_the_view_is_ink(program):
    app = program()
    app.do("mousemove", 700, 60)
    app.settled()
    app.keys(*["bracketright"] * 20)
    app.stroke(*[(x, y + 200) for x, y in LINE])
    app.keys("t")  # what was in the middle stays there: the stroke is 200 pixels higher
    opened = parked(app)
    click(app, VIEW)
    matched = until(app, lambda screen: screen[TEXTURE].std() > 6 and screen[EXAMPLE].std() > 6)
    assert changed(matched[SECOND], opened[SECOND]) < 50

    # Another seed, another texture.
    click(app, DICE)
    thrown = until(app, lambda screen: changed(screen[TEXTURE], matched[TEXTURE]) > 500)

    # A rectangle marked on the canvas is the second example; the two are mixed.
    click(app, SECOND_AREA)
    parked(app)
    app.stroke((340, 90), (400, 110), (520, 150))
    mixed = until(app, lambda screen: screen[SECOND].std() > 6)
    assert changed(mixed[CANVAS], thrown[CANVAS]) < 50  # nothing was painted

    # Used as ink, it is painted with.
    click(app, USE)
    until(app, lambda screen: changed(screen[MIXER], mixed[MIXER]) > 300)
    app.stroke(*[(x, y + 180) for x, y in LINE])
    stroke = (slice(280, 320), slice(320, 860))
    painted = until(app, lambda screen: changed(screen[stroke], mixed[stroke]) > 3000)
    core = painted[298:302, 400:800].reshape(-1, 3)
    assert len(np.unique(core, axis=0)) > 40  # plain paint is even
    app.keys("t")
    until(app, lambda screen: changed(screen[TEXTURE], painted[TEXTURE]) > 3000)
