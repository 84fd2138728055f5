"""An endless zoom: the first picture of a film is its last, whatever turns in it."""

from dataclasses import replace

import numpy as np
import pytest
from imgui_bundle import imgui  # noqa: F401  # before glfw, so that both use one libglfw

from app.actions.actions import ACTIONS, perform
from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.places.endless import endless
from engine.canvas.layers import EMPTY
from engine.canvas.layers import layers as all_layers
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose, SourcePart
from engine.film.aim import aim_of
from engine.film.closing import carried, others
from engine.film.shooting import Film, Shooting
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session
from engine.studio import outline
from engine.studio.requests import Do
from engine.studio.results import Scene

FRAME = SourcePart(0, Rect(0, 0, 256, 256))
INK = [{"texture": "rock", "colour": "#ffe0a0", "period": 40}]


@pytest.fixture(scope="module")
def filled():
    session = Session()
    for radius, points, colour, ink in (
        (200, [[-50, 60], [300, 200]], "#406080", INK),
        (12, [[20, 30], [240, 60]], "#c03020", []),
        (9, [[30, 220], [120, 130], [230, 240]], "#20a050", []),
    ):
        brush = {"radius": radius, "hardness": 1, "colour": colour, "ink": ink}
        session.do(c.parse({"do": "stroke", "points": points, "brush": brush}))
    return session.painting


def itself(painting, pose):
    layer = next(all_layers(painting.root))
    root = replace(EMPTY, children=(layer, Placement(9, "itself", pose=pose, part=FRAME)))
    return replace(painting, root=root)


def film(painting, pose, size, back=False):
    """The first and the last picture of the way from one place to the other."""
    ends = tuple(aim_of(bookmark, size) for bookmark in endless("itself", pose, FRAME))
    shooting = Shooting(Film(ends[::-1] if back else ends, size, 3.0, 1.0), itself(painting, pose))
    frames = [frame.astype(int) for frame in shooting.frames(1)]
    assert len(frames) == 3
    assert np.ptp(frames[0]) > 50
    assert np.abs(frames[1] - frames[0]).max() > 30
    return frames[0], frames[-1]


@pytest.mark.parametrize(
    "pose",
    [Pose((60, 70), levels=-1), Pose((90, 64), levels=-2), Pose((0, 0), levels=-1), Pose((72, 64), levels=-1)],
)
@pytest.mark.parametrize("size", [(96, 54), (40, 70)])
def test_the_film_closes_to_the_bit(filled, pose, size):
    first, last = film(filled, pose, size)
    np.testing.assert_array_equal(first, last)


TURNED = [
    Pose((190, 60), levels=-1, turn=1),
    Pose((190, 60), levels=-1, mirror=True),
    Pose((60, 190), levels=-1, turn=3, mirror=True),
    Pose((90, 30), turned=(0.9, 0.41), levels=-1),
    Pose((190, 60), turned=(0.9, 0.41), levels=-1, mirror=True),
]


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize("pose", TURNED)
def test_a_film_of_a_turn_closes_to_the_bit(filled, pose, back):
    first, last = film(filled, pose, (96, 54), back)
    np.testing.assert_array_equal(first, last)


@pytest.mark.parametrize("pose", TURNED)
def test_what_a_film_begins_with_is_what_lies_there(filled, pose):
    size = 96, 54
    outer, inner = (aim_of(bookmark, size) for bookmark in endless("itself", pose, FRAME))
    for aim in (outer, replace(outer.at(outer.level, outer.fraction + 0.2).moved(3.25, -2.5), turn=outer.turn + 0.3)):
        deeper = carried(aim, outer, inner)
        seen = [next(Shooting(Film((at,), size), itself(filled, pose)).frames(1)).astype(int) for at in (aim, deeper)]
        away = np.abs(seen[0] - seen[1])
        assert away.mean() <= (0.3 if pose.turned is None else 2.5)  # those are sampled once: hard rims are softer
        back = carried(deeper, inner, outer)
        assert abs(back.turn - aim.turn) < 1e-9
        assert max(abs(back.x - aim.x), abs(back.y - aim.y)) < 8


def test_a_film_that_does_not_end_a_turn_deeper_shows_nothing_else(filled):
    pose = TURNED[0]
    outer, inner = (aim_of(bookmark, (96, 54)) for bookmark in endless("itself", pose, FRAME))
    root = itself(filled, pose).root
    assert others([outer, inner], root)[0] == (inner, 1.0)
    assert others([inner, outer], root)[1] == (inner, 1.0)
    for end in (inner.moved(5, 0), replace(inner, turn=inner.turn + 0.1), replace(inner, mirrored=1.0), outer):
        assert not others([outer, end], root)
    assert not others([outer, inner], filled.root)
    hidden = (root.children[0], replace(root.children[1], visible=False))
    assert not others([outer, inner], replace(root, children=hidden))


def scene_of(session, active):
    rows = tuple(outline.rows(session.painting.root))
    marks = tuple(session.painting.bookmarks.values())
    return Scene(session.painting.frame, rows, active, False, False, modified=False, path=None, bookmarks=marks)


def test_the_menus_make_a_picture_in_itself_and_the_way_into_it(filled):
    posted = []
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), posted.append)
    session = Session(filled)
    layer = next(all_layers(filled.root)).name
    desk.known = replace(desk.known, ready=True, scene=scene_of(session, layer))
    assert not perform(desk, ACTIONS["endless"])
    assert perform(desk, ACTIONS["in_itself"])
    for asked in posted:
        session.do(asked.command)
    posted.clear()
    name = session.painting.root.children[-1].name
    assert session.painting.active == name
    desk.known = replace(desk.known, scene=scene_of(session, layer))  # whatever layer is chosen
    for _ in range(2):  # asked for twice, it bookmarks other names
        assert perform(desk, ACTIONS["endless"])
        for asked in posted:
            if isinstance(asked, Do):
                session.do(c.parse(c.to_json(asked.command)))  # as it is journalled
        posted.clear()
        desk.known = replace(desk.known, scene=scene_of(session, name))
    marks = session.painting.bookmarks
    assert [mark.rsplit(" ", 1)[1] for mark in marks] == ["out", "in", "out", "in"]
    outer, inner = list(marks.values())[:2]
    assert inner.level == outer.level + 1
