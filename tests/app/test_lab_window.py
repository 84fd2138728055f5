"""The texture lab in the real window: paint in the spectrum, paint with what it makes."""

import numpy as np
import pytest
from screens import changed

pytestmark = pytest.mark.window

POINTER = (700, 60)  # on the canvas, where it covers nothing that is looked at
FACTS = ("Power spectrum", "Autocorrelation", "All-pole model", "Regions")
LINE = [(300 + 20 * i, 200 + (25 if i % 6 < 3 else -25)) for i in range(30)]


@pytest.mark.nightly
def test_paint_a_spectrum_then_paint_with_it(program):
    app = program()
    app.do("mousemove", *POINTER)
    app.settled()
    app.keys("l")
    spectrum, texture = app.part("spectrum"), app.part("texture")
    opened = app.until(lambda screen: screen[texture].std() > 25, POINTER)  # the first shape is noise
    loud = opened[spectrum]
    side = len(loud)
    assert loud[side // 2, side // 6 : -side // 6].mean() > loud[:10, :10].mean()  # in the middle

    # A stroke appears at the opposite frequency too, and the texture follows.
    begun = app.at("spectrum", 0.28, 0.22)
    app.stroke(*[(begun[0] + 3 * i, begun[1] + 2 * i) for i in range(12)])
    painted = app.until(lambda screen: changed(screen[texture], opened[texture]) > 3000, POINTER)
    difference = np.abs(painted[spectrum] - opened[spectrum]).max(axis=-1) > 12
    assert difference[: side // 2].sum() > 100
    assert difference[side // 2 :].sum() > 100

    # Undo over the spectrum is the lab's: a key is meant for what the pointer is over when a slow frame comes to it.
    over = app.at("spectrum")
    app.do("mousemove", *over)
    app.keys("ctrl+z")
    app.until(lambda screen: changed(screen[texture], opened[texture]) < 50, over)
    app.keys("ctrl+shift+z")
    app.until(lambda screen: changed(screen[texture], painted[texture]) < 50, over)

    # Used as ink, it is what the next stroke is painted with.
    app.click("Use as ink")
    app.keys(*["bracketright"] * 20)
    app.stroke(*LINE)
    stroke = (slice(190, 212), slice(320, 860))
    first = app.until(lambda screen: changed(screen[stroke], opened[stroke]) > 3000, POINTER)
    assert first[stroke].std(axis=1).mean() > 20  # plain paint would be even

    # It follows the lab: another spectrum, and the next stroke is another one.
    app.click("In view")
    app.until(lambda screen: changed(screen[texture], painted[texture]) > 3000, POINTER)
    app.move_to(POINTER)
    app.keys("ctrl+z")
    app.until(lambda screen: changed(screen[stroke], opened[stroke]) < 50, POINTER)
    app.stroke(*LINE)
    second = app.until(lambda screen: changed(screen[stroke], opened[stroke]) > 3000, POINTER)
    assert changed(second[stroke], first[stroke]) > 1500


def test_analysis_finds_its_facts(program):
    app = program()
    app.do("mousemove", *POINTER)
    empty = app.canvas()
    app.stroke(*[(x, y + 200) for x, y in LINE])
    app.canvas_unlike(empty)
    before = app.parked(POINTER)
    app.keys("a")
    app.box("What is in view")
    found = [app.part(name) for name in FACTS]
    app.until(lambda screen: all(screen[part].std() > 5 for part in found), POINTER)
    app.keys("a")
    app.until_gone("What is in view")
    app.until(lambda screen: changed(screen[60:760, 270:970], before[60:760, 270:970]) < 50, POINTER)
