"""The matching panel without a window: what it asks for, what may be dropped on it, the gains of its cells."""

from pathlib import Path

import pytest
from immutables import Map

from app.desk.match_state import MatchState, title
from app.panels.match.subbands import gain_of, part_of
from engine.makers import definitions
from engine.numeric.address import Rect
from engine.painting.commands import DefineTexture, parse, to_json
from engine.studio.textures.texture_requests import MatchSet, MatchUse


def state(*names):
    made = MatchState()
    for index, name in enumerate(names):
        made.show_file(index, Path(f"/pictures/{name}"))
    return made


def test_nothing_is_asked_for_without_an_example_and_changes_once():
    made, posted = MatchState(), []
    made.ask(posted.append)
    made.ask(posted.append)
    assert posted == [MatchSet("match", None)]
    made.show_area(0, 3, Rect(-5, 7, 25, 47))
    made.ask(posted.append)
    made.ask(posted.append)
    assert posted[1:] == [
        MatchSet(
            "match", Map({"rect": (3, -5, 7, 30, 40), "size": (256, 256), "detail": "learnt", "structure": "objects"})
        )
    ]


def test_what_is_not_changed_is_not_told():
    made = state("a.png")
    made.levels = 3
    made.axes[0] = 0.5
    assert made.arguments() == Map(
        {"path": "/pictures/a.png", "size": (256, 256), "detail": "learnt", "structure": "objects"}
    )
    made.keep("none")
    assert set(made.arguments()) == {"path", "size", "detail", "levels", "axes"}
    made.levels, made.axes[0] = 4, 1.0
    assert made.arguments() == Map({"path": "/pictures/a.png", "size": (256, 256), "detail": "learnt"})
    made.bands = {(0, 1): (2.0, None), (1, 0): (1.0, None), (-1, None): (1.0, ((0.0, 0.0), (1.0, 0.5)))}
    made.axes[1] = 0.5
    told = made.arguments()
    assert {dict(band).get("level") for band in told["bands"]} == {0, -1}
    assert told["axes"] == (1.0, 0.5, 1.0, 1.0)


def test_a_mixture_is_one_and_a_series_only_for_use():
    made, posted = state("a.png", "b.png"), []
    made.pressed = True
    made.ask(posted.append)
    assert posted[0].maker == "mix"
    assert posted[0].arguments["pattern"] == "/pictures/b.png"
    assert "stages" not in posted[0].arguments
    assert posted[0].arguments["structure"] == "statistics"
    made.keep("full")
    assert (made.kept, made.structure) == ("full", "objects")
    made.use(posted.append, "ink", "Both")
    assert isinstance(posted[1], MatchUse)
    command = DefineTexture("Both", posted[1].maker, posted[1].arguments)
    assert definitions.kind_of(command) == "series"
    assert parse(to_json(command)) == command
    for how, members in (("palette", set()), ("bands", {"split"})):
        made.how = how
        assert set(made.arguments()) == {"path", "pattern", "how", "size", "detail", *members}
        assert not made.by_pressure


def test_the_second_takes_the_place_of_the_first():
    made = state("a.png", "b.png")
    made.show(0, None)
    assert [example and title(example) for example in made.examples] == ["b.png", None]
    made.show(0, None)
    assert made.arguments() is None
    assert title(Map({"rect": (2, 0, 0, 30, 40)})) == "Canvas, level 2, 30 × 40"


@pytest.mark.parametrize(
    ("name", "x", "y", "expected"),
    [
        ("new.png", 5, 5, ["new.png", None]),
        ("new.JPG", 5, 15, ["a.png", "new.JPG"]),
        ("new.tif", 50, 50, ["new.tif", None]),
        ("new.ora", 5, 5, None),
        ("new.png", 500, 5, None),
    ],
)
def test_dropped_pictures(name, x, y, expected):
    made = state("a.png")
    made.spots = {0: (0, 0, 10, 10), 1: (0, 10, 10, 20), 2: (0, 0, 100, 100)}
    assert made.dropped(Path(name), x, y) == (expected is not None)
    assert [example and title(example) for example in made.examples] == (expected or ["a.png", None])


def test_another_pyramid_has_other_subbands():
    made = state("a.png")
    made.bands, made.chosen = {(3, 2): (2.0, None)}, (3, 2)
    made.reshape(4, 4)
    assert made.bands
    made.reshape(2, 4)
    assert not made.bands
    assert made.chosen == (0, 0)


def test_cells_show_the_gain_that_they_give():
    assert part_of(1.0) == 0.5
    assert (gain_of(0.0), gain_of(0.5), gain_of(1.0), gain_of(9.0)) == (0.0, 1.0, 4.0, 4.0)
    for k in range(41):
        assert abs(part_of(gain_of(k / 40)) - k / 40) < 0.02
