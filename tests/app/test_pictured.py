"""Pictures as ink in the window: what is asked of the engine, and that the engine does it."""

from types import SimpleNamespace

import numpy as np
from PIL import Image

from app.canvas.view import View, place_of_pixel
from app.desk.asked import Asked
from app.desk.known import Known
from app.desk.outside import pictured
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.settings import Brush, Component
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session


def desk(session=None):
    """A desk of which only what `pictured` looks at is there; what it posts is done at once."""
    posted = []
    view = View(place_of_pixel(0, 60, 40), 0, 0.0, width=200, height=160)
    seen = SimpleNamespace(textures=("View",))
    made = SimpleNamespace(
        view=view, known=Known(scene=seen), asked=Asked(), free_area=lambda: (20.0, 10.0, 180.0, 150.0)
    )
    made.post = lambda request: posted.append(request.command) or (session and session.do(request.command))
    return made, posted


def painted():
    session = Session()
    session.do(c.parse({"do": "stroke", "points": [[0, 0], [120, 80]], "brush": {"radius": 30, "colour": "#c04020"}}))
    return session


def test_what_is_in_view_becomes_ink_that_survives_a_file(tmp_path):
    session = painted()
    made, posted = desk(session)
    pictured.from_view(made)
    assert made.asked.texture == "View 2"
    rect = pictured.seen(made)
    assert (rect.width, rect.height) == (160, 140)
    assert posted[0].arguments["rect"] == (0, rect.x0, rect.y0, 160, 140)
    brush = Brush(radius=50.0, ink=(Component("View 2", 1.0, "#ffffff"),))
    live = session.begin(0, (300, 300), brush)
    live.add(np.array([[0.0, 0.0]]))
    session.finish(live)
    layer = next(iter(layers.layers(session.painting.root)))
    shown = evaluate(layer.pyramid, 0, Rect.at(250, 250, 100, 100))
    assert shown.rgba[0].max() > 0.7
    save(tmp_path / "a.ora", Snapshot(session.painting))
    again = next(iter(layers.layers(open_painting(tmp_path / "a.ora").painting.root)))
    assert (evaluate(again.pyramid, 2, Rect.at(1000, 1000, 300, 300)).data == evaluate(
        layer.pyramid, 2, Rect.at(1000, 1000, 300, 300)).data).all()  # fmt: skip


def test_a_picture_file_becomes_ink_under_its_name(tmp_path):
    rng = np.random.default_rng(0)
    Image.fromarray(rng.integers(0, 256, (40, 60, 3), np.uint8)).save(tmp_path / "Brick wall.png")
    session = painted()
    made, posted = desk(session)
    pictured.from_file(made, tmp_path / "Brick wall.png")
    assert made.asked.texture == posted[0].name == "Brick wall"
    assert session.painting.textures["Brick wall"].source.width == 60
