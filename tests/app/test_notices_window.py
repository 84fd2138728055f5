"""What goes wrong with files stays in the real window, with what can be done about it, and leaves the painting."""

import io
import time
import zipfile

import pytest
from PIL import Image

pytestmark = pytest.mark.window

MODES = ("krita:grain_merge", "krita:hue_hsi", "svg:none", "x:y", "z")


def foreign(path):
    """An OpenRaster file whose layers have modes that nobody knows."""
    picture = io.BytesIO()
    Image.new("RGBA", (300, 200), (200, 60, 30, 255)).save(picture, "PNG")
    layers = "".join(f'<layer name="{n}" src="data/a.png" composite-op="{op}"/>' for n, op in enumerate(MODES))
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", "image/openraster")
        archive.writestr("stack.xml", f'<image w="300" h="200"><stack>{layers}</stack></image>')
        archive.writestr("data/a.png", picture.getvalue())


def opens(app, path):
    app.keys("ctrl+o")
    app.click(path.name, "Open")
    app.click("Open", "Open")
    app.until_gone("name")


@pytest.mark.nightly
def test_what_goes_wrong_stays_until_it_is_dealt_with(program, tmp_path):
    stick = tmp_path / "usb"
    app = program()
    empty = app.canvas()
    app.stroke((400, 300), (700, 500))
    painted = app.canvas_unlike(empty)
    app.keys("ctrl+s")
    app.box("name", "Save as")
    time.sleep(0.5)
    app.fill(str(stick / "a.ora"))
    app.keys("Return")
    app.box("Try again", "status")
    assert app.box("Save as…", "status")
    assert app.comes_to(painted), "the canvas moved"
    app.keys("h")  # says nothing, and the line is still there
    stick.mkdir()
    foreign(stick / "foreign.ora")
    (stick / "none.ora").write_bytes(b"no painting at all")
    app.click("Try again")
    app.until_gone("Try again")
    end = time.monotonic() + 90.0
    while not (stick / "a.ora").exists():
        assert time.monotonic() < end, "nothing was saved"
        time.sleep(0.1)
    opens(app, stick / "none.ora")
    app.box("Try again", "status")
    assert app.box("1 note")
    assert app.comes_to(painted), "a refused file took the painting"
    opens(app, stick / "foreign.ora")
    app.canvas_unlike(painted)
    app.until_gone("Try again")  # another file was opened
    app.click("Details", "status")
    lines = [app.box(f"layer '{n}': mode '{op}' is not known; shown as normal") for n, op in enumerate(MODES)]
    assert sorted(lines, key=lambda box: box[1]) == lines or sorted(lines, key=lambda box: -box[1]) == lines
    app.keys("Escape")
    app.until_gone(f"layer '0': mode '{MODES[0]}' is not known; shown as normal")
    app.click("close note", "status")
    app.until_gone("1 note")
