"""Files dropped on the real window: onto the palette of examples, and on the canvas."""

import threading
import time
import zipfile
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from dragging import Drag, window_of
from driven import PATIENCE
from PIL import Image
from psd_tools import PSDImage

pytestmark = pytest.mark.window

MOVES = 100  # of the pointer
TRIES = 4  # something else may have the processor in each of them, but for the last
PLACES = {"examples": "p", "match": "t", "lab": "l", "canvas": "l"}  # and the key that opens, or closes, it


@pytest.fixture
def stone(tmp_path):
    """A picture with a place that needs escaping, grey on white."""
    folder = tmp_path / "my pictures ü"
    folder.mkdir()
    y, x = np.mgrid[:80, :120]
    inside = ((x - 60) / 50.0) ** 2 + ((y - 40) / 32.0) ** 2 < 1.0
    pixels = np.where(inside[..., None], 90 + (x * y % 60)[..., None], 255) * np.ones(3)
    Image.fromarray(pixels.astype(np.uint8)).save(folder / "A 100% stone.png")
    return folder / "A 100% stone.png"


@pytest.fixture(scope="module")
def photograph(tmp_path_factory):
    """A JPEG of 24 million pixels, as cameras write them: 6000 x 4000."""
    small = np.random.default_rng(5).integers(0, 255, (400, 600, 3)).astype(np.uint8)
    path = tmp_path_factory.mktemp("camera") / "photograph.jpg"
    Image.fromarray(small).resize((6000, 4000), Image.Resampling.BICUBIC).save(path, quality=92)
    return path


def until(good, seconds=PATIENCE):
    end = time.monotonic() + seconds
    while not good():
        assert time.monotonic() < end
        time.sleep(0.1)


def shows(screen, path):
    """Whether a part of the screen shows a picture, as large as there is room for: some of it may be dimmed."""
    small = Image.fromarray(screen).convert("L").resize((30, 20), Image.Resampling.BOX)
    expected = Image.open(path).convert("L").resize((30, 20), Image.Resampling.BOX)
    return np.std(small) > 5 and np.corrcoef(np.ravel(small), np.ravel(expected))[0, 1] > 0.7


def test_a_picture_dropped_while_the_palette_is_open_is_an_example(program, stone):
    app = program()
    app.do("mousemove", 640, 300)
    app.keys("p")
    Drag(app.display, window_of(app), stone).drop(*app.at("sample"))
    made = app.folder / "data" / "inkfall" / "examples"
    until(lambda: len(list(made.glob("*.toml"))) == 1)
    assert {path.name for path in made.iterdir()} == {f"A 100- stone{end}" for end in (".png", ".mask.png", ".toml")}
    region = app.part("region")
    until(lambda: shows(app.screen()[region], stone))


@pytest.mark.nightly
def test_a_picture_dropped_on_the_canvas_is_opened_if_it_is_to_be(program, stone):
    app = program()
    app.settled()
    Drag(app.display, window_of(app), stone).drop(*app.at("canvas"))
    app.click("Open")
    app.wait_for("painting 1 shown")
    assert '["status", "Opening A 100% stone.png"' in app.log.read_text()
    app.until_gone("Opening A 100% stone.png")
    assert not (app.folder / "data" / "inkfall" / "examples").exists()


def test_a_picture_dropped_on_the_canvas_is_laid_there_as_a_layer_that_can_be_moved(program, stone):
    app = program()
    app.settled()
    app.do("mousemove", 500, 400)
    Drag(app.display, window_of(app), stone).drop(500, 400)
    app.click("Layer")
    until(lambda: shows(app.screen()[373:427, 459:541], stone))  # a pixel on a pixel of the frame, seen 1 : 1.46
    app.until_rest()  # its box is there
    app.do("mousemove", 500, 400, "mousedown", 1, "mousemove", 560, 430, "mousemove", 600, 460, "mouseup", 1)
    until(lambda: shows(app.screen()[433:487, 559:641], stone))
    app.keys("ctrl+z", "ctrl+z")
    until(lambda: not shows(app.screen()[433:487, 559:641], stone))


@pytest.mark.nightly
def test_a_picture_can_be_brought_in_as_a_reference_that_no_export_shows(program, stone):
    app = program()
    app.settled()
    app.do("mousemove", 500, 400)
    Drag(app.display, window_of(app), stone).drop(500, 400)
    app.click("Reference")
    until(lambda: shows(app.screen()[373:427, 459:541], stone))
    app.save_as(app.folder / "ours.ora")
    with zipfile.ZipFile(app.folder / "ours.ora") as file, Image.open(file.open("mergedimage.png")) as merged:
        assert not np.asarray(merged)[..., 3].any()


def test_a_photoshop_file_comes_in_as_a_group_in_one_step(program, tmp_path):
    blue, orange = (20, 60, 220), (240, 130, 10)
    image = PSDImage.new("RGB", (300, 200))
    image.create_pixel_layer(Image.new("RGBA", (300, 200), (*blue, 255)), name="Wall")
    group = image.create_group(name="Pictures")
    group.create_pixel_layer(Image.new("RGBA", (100, 80), (*orange, 255)), name="Frame", top=60, left=100)
    image.save(tmp_path / "room.psd")
    app = program()
    app.settled()
    app.do("mousemove", 500, 400)
    Drag(app.display, window_of(app), tmp_path / "room.psd").drop(500, 400)
    app.click("Group")

    def is_at(x, y, colour):
        return np.abs(app.screen()[y, x, :3].astype(int) - colour).max() < 4

    until(lambda: is_at(480, 390, orange) and is_at(420, 350, blue))
    for name in ("room", "Wall", "Pictures", "Frame"):
        app.box(name)
    app.until_rest()
    app.do("mousemove", 500, 400, "mousedown", 1, "mousemove", 560, 430, "mousemove", 600, 460, "mouseup", 1)
    until(lambda: is_at(580, 450, orange) and is_at(520, 410, blue))
    app.keys("ctrl+z", "ctrl+z")
    until(lambda: not is_at(580, 450, orange) and not is_at(420, 350, blue))
    app.until_gone("Frame")


def longest(app, act):
    """The longest time from one frame to the next while `act` is done and the pointer moves over the window, seconds:
    by the clock, and of the processor for the window's thread."""
    before, done = app.log.read_text().count("frame: "), threading.Event()
    with ThreadPoolExecutor(1) as pool:
        acting = pool.submit(act)
        acting.add_done_callback(lambda _: done.set())
        rest = MOVES
        while rest:
            app.do("mousemove", 500 + rest, 600 + rest % 2)
            time.sleep(0.02)
            rest -= done.is_set()
        acting.result()
    lines = [line.split() for line in app.log.read_text().splitlines() if line.startswith("frame: ")][before:]
    assert len(lines) > 10
    times = [[float(words[1]) / 1000, float(words[3]) / 1000] for words in lines]
    return np.diff(times, axis=0).max(axis=0)


def reading(path):
    """Seconds of the processor that it takes to read a picture."""
    start = time.process_time()
    np.asarray(Image.open(path).convert("RGBA"))
    return time.process_time() - start


@pytest.mark.nightly
def test_a_photograph_that_is_dropped_anywhere_loses_no_frame(program, photograph):
    """Reading it takes as long as many frames; none is longer than those before, but for noise, which is not there each
    time."""
    app = program(trace="frames")
    app.do("mousemove", 640, 300)
    app.settled()
    usual = longest(app, lambda: None)
    # By the clock, what else the machine does counts, too; of the processor, only what the window's thread does.
    most = np.maximum(3 * usual, np.array([2.0, 0.25]) * reading(photograph))
    for place, key in PLACES.items():
        if key:
            app.do("mousemove", 640, 300)
            app.keys(key)
        app.settled()
        found = []
        while not found or (found[-1] >= most).any():
            assert len(found) < TRIES, f"{place}: {found} s, expected less than {most}; before it {usual}"
            found.append(longest(app, lambda: Drag(app.display, window_of(app), photograph).drop(600, 600)))
            if place in ("lab", "canvas"):
                app.keys("Escape")  # it is asked what is to become of it
    until(lambda: len(list((app.folder / "data" / "inkfall" / "examples").glob("*.toml"))) >= 1)


def test_another_programs_brush_dropped_on_the_canvas_is_painted_with(program, tmp_path):
    (tmp_path / "Soft reed.myb").write_text(
        '{"version": 3, "settings": {"radius_logarithmic": {"base_value": 3.5, "inputs": {}},'
        ' "opaque": {"base_value": 1.0, "inputs": {}}, "slow_tracking": {"base_value": 2.0, "inputs": {}}}}'
    )
    app = program()
    app.settled()
    Drag(app.display, window_of(app), tmp_path / "Soft reed.myb").drop(*app.at("canvas"))
    app.box("Brought in the brush “Soft reed”, without slow tracking")
    assert (app.folder / "config" / "inkfall" / "brushes" / "soft-reed.json").is_file()
    before = app.canvas()
    app.stroke((500, 300), (600, 310), (700, 320))
    assert (app.canvas_unlike(before)[230:280, 270:400] < 60).mean() > 0.1
