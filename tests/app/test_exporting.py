"""What is chosen of a picture that is to be exported, and the files that come of it."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.exporting.export_areas import AREAS, export_bytes, export_place, export_wish
from app.desk.exporting.export_state import EXPORT_FORMATS, FINER
from engine.checks.roles import REFERENCE
from engine.files.fault import WriteError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session.apply import apply
from engine.studio import requests as q
from engine.studio.filing.documents import beside, write_picture
from engine.studio.results import Scene
from engine.studio.selecting.ants_records import Ants, Measure

FRAME = Rect(10, 20, 74, 52)


def desk(selected=None):
    made = Desk(View(Place(0, 0, 0), 3, 0.0, 640, 480), [].append)
    made.learn(scene=Scene(FRAME, (), None, False, False, False, None))
    if selected is not None:
        made.selecting.ants = Ants(True, (), 0, FRAME, np.zeros((0, 4)), True, None, Measure(*selected, 0))
    return made


@pytest.mark.parametrize("name", EXPORT_FORMATS)
def test_every_format_asks_for_what_its_files_have(name, tmp_path):
    screen = desk()
    screen.export.format = name
    wish = export_wish(screen, tmp_path / f"a{EXPORT_FORMATS[name].ending}")
    assert (wish.level, wish.area) == (0, None)
    write_picture(wish, painted())
    written = tmp_path / f"a{EXPORT_FORMATS[name].ending}"
    assert written.stat().st_size <= export_bytes(screen) + 2000


@pytest.mark.parametrize("finer", [FINER[0], 0, 3])
def test_what_is_exported_is_the_frame_the_view_or_around_the_selection(finer):
    screen = desk((2, Rect(40, 80, 60, 100)))
    screen.export.finer = finer
    assert export_place(screen) == (finer, FRAME.zoomed(finer))
    screen.export.area = "view"
    screen.insets = 100.0, 20.0, 40.0, 10.0
    level, rect = export_place(screen)
    seen = screen.view.visible(3).zoomed(finer)
    assert level == 3 + finer
    assert rect.union(seen) == seen
    near = 2 * max(1, 2**-finer)  # a pixel at either side
    assert abs(rect.width / 2.0**finer - 500) <= near
    assert abs(rect.height / 2.0**finer - 450) <= near
    screen.export.area, screen.export.painted = "painted", Rect(-50, 0, 200, 90)
    assert export_place(screen) == (finer, Rect(-50, 0, 200, 90).zoomed(finer))
    screen.export.area = "selection"
    wish = export_wish(screen, Path("a.png"))
    assert (wish.level, wish.area) == (2 + finer, Rect(40, 80, 60, 100).zoomed(finer))


def test_where_nothing_is_selected_any_more_the_frame_is_exported():
    screen = desk()
    assert AREAS["selection"].of(screen) is None
    screen.export.area = "selection"
    assert export_wish(screen, Path("a.png")).area is None
    screen.export.area, screen.export.painted = "painted", Rect(0, 0, 0, 0)
    assert export_wish(screen, Path("a.png")).area is None


def painted():
    made = apply(Painting(FRAME, 3), c.SetPaper("#ffffff"))
    for name, colour in (("One", "#ff0000"), ("a/b:c", "#0000ff")):
        made = apply(made, c.AddLayer(name))
        made = apply(made, c.parse({"do": "stroke", "points": [[30, 30], [50, 40]], "brush": {"colour": colour}}))
    return made


def test_each_layer_goes_to_a_file_of_its_own_without_paper_and_none_is_replaced(tmp_path):
    painting = apply(painted(), c.AddLayer("Photograph"))
    painting = apply(painting, c.SetLayer("Photograph", role=REFERENCE))
    wish = q.Export(tmp_path / "p.png", apart=True, depth=16)
    write_picture(wish, painting)
    assert {path.name for path in tmp_path.iterdir()} == {"p One.png", "p a_b_c.png"}
    pixels = np.asarray(Image.open(tmp_path / "p a_b_c.png").convert("RGBA"))
    assert pixels.shape == (32, 64, 4)
    assert pixels[0, 0, 3] == 0
    assert pixels[15, 30].tolist() == [0, 0, 255, 255]
    (tmp_path / "p One.png").unlink()
    before = (tmp_path / "p a_b_c.png").read_bytes()
    with pytest.raises(WriteError, match="a_b_c"):
        write_picture(wish, painting)
    assert not (tmp_path / "p One.png").exists()
    assert (tmp_path / "p a_b_c.png").read_bytes() == before


def test_files_of_layers_have_names_that_any_system_takes_and_no_two_the_same():
    found = beside(Path("x.png"), ["a", "A", "a/b", "a:b", "  ", "..", "n" * 400, "n" * 401])
    names = [path.name for path in found]
    assert len({name.casefold() for name in names}) == len(names)
    assert all(len(name) < 140 and not set('/\\:*?"<>|') & set(name) for name in names)


def test_without_paper_nothing_lies_where_nobody_painted(tmp_path):
    for transparent, alpha in ((False, 255), (True, 0)):
        write_picture(q.Export(tmp_path / "p.png", transparent=transparent), painted())
        assert np.asarray(Image.open(tmp_path / "p.png").convert("RGBA"))[0, 0, 3] == alpha


def test_what_is_too_large_for_a_file_is_seen_before(tmp_path):
    screen = desk((0, Rect(0, 0, 1 << 14, 1 << 14)))
    screen.export.area, screen.export.finer = "selection", 8
    with pytest.raises(WriteError, match="1048576"):
        write_picture(export_wish(screen, tmp_path / "p.png"), painted())
    assert not list(tmp_path.iterdir())
