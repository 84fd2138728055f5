"""The texture lab in the real window: paint in the spectrum, paint with what it makes."""

import time

import numpy as np
import pytest
from screens import changed

pytestmark = [pytest.mark.window, pytest.mark.timeout(240)]

OVER = (400, 600)  # on the spectrum: a key is meant for what the pointer is over when a slow frame comes to it
POINTER = (700, 60)  # where it covers nothing that is looked at
SPECTRUM = (slice(470, 710), slice(270, 510))
TEXTURE = (slice(470, 690), slice(535, 750))
USE_AS_INK = (810, 755)
LINE = [(300 + 20 * i, 200 + (25 if i % 6 < 3 else -25)) for i in range(30)]


def test_paint_a_spectrum_then_paint_with_it(program):
    app = program()
    app.do("mousemove", 700, 60)
    app.settled()
    app.keys("l")
    opened = app.until(lambda screen: screen[TEXTURE].std() > 25, POINTER)  # the first shape is noise
    assert opened[590, 300:480].mean() > opened[475, 275:285].mean()  # loud in the middle

    # A stroke appears at the opposite frequency too, and the texture follows.
    app.stroke(*[(330 + 3 * i, 520 + 2 * i) for i in range(12)])
    painted = app.until(lambda screen: changed(screen[TEXTURE], opened[TEXTURE]) > 3000, POINTER)
    difference = np.abs(painted[SPECTRUM] - opened[SPECTRUM]).max(axis=-1) > 12
    assert difference[:120].sum() > 100
    assert difference[120:].sum() > 100

    # Undo over the spectrum is the lab's.
    app.do("mousemove", *OVER)
    app.keys("ctrl+z")
    app.until(lambda screen: changed(screen[TEXTURE], opened[TEXTURE]) < 50, OVER)
    app.keys("ctrl+shift+z")
    app.until(lambda screen: changed(screen[TEXTURE], painted[TEXTURE]) < 50, OVER)

    # Used as ink, it is what the next stroke is painted with.
    app.do("mousemove", *USE_AS_INK)
    time.sleep(0.2)
    app.do("click", 1)
    app.do("key", "--repeat", 20, "--delay", 30, "bracketright")
    app.stroke(*LINE)
    stroke = (slice(190, 212), slice(320, 860))
    first = app.until(lambda screen: changed(screen[stroke], opened[stroke]) > 3000, POINTER)
    assert first[stroke].std(axis=1).mean() > 20  # plain paint would be even

    # It follows the lab: another spectrum, and the next stroke is another one.
    app.do("mousemove", 815, 491)
    time.sleep(0.2)
    app.do("click", 1)
    app.until(lambda screen: changed(screen[TEXTURE], painted[TEXTURE]) > 3000, POINTER)
    time.sleep(0.5)
    app.do("mousemove", 700, 60)
    app.keys("ctrl+z")
    app.until(lambda screen: changed(screen[stroke], opened[stroke]) < 50, POINTER)
    app.stroke(*LINE)
    second = app.until(lambda screen: changed(screen[stroke], opened[stroke]) > 3000, POINTER)
    assert changed(second[stroke], first[stroke]) > 1500


def test_analysis_finds_its_facts(program):
    app = program()
    app.do("mousemove", 700, 60)
    app.settled()
    app.stroke(*[(x, y + 200) for x, y in LINE])
    before = app.parked(POINTER)
    app.keys("a")
    app.until(lambda screen: changed(screen[500:620, 480:980], before[500:620, 480:980]) > 3000, POINTER)
    app.keys("a")
    app.until(lambda screen: changed(screen[60:760, 270:970], before[60:760, 270:970]) < 50, POINTER)
