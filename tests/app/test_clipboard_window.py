"""Pictures that go to other programs and come from them, over the clipboard of a real display."""

import subprocess
import sys

import numpy as np
import pytest

pytestmark = pytest.mark.window
OTHER = """
import sys, time, copykitten
if sys.argv[1] == "give":
    copykitten.copy_image(bytes([200, 40, 30, 255]) * 120 * 80, 120, 80)
    print("given", flush=True)
    time.sleep(300)
else:
    pixels, width, height = copykitten.paste_image()
    print(width, height, *pixels[(height // 2 * width + width // 2) * 4:][:4])
"""


def other(app, *words) -> subprocess.Popen:
    environment = {"DISPLAY": app.display, "PATH": "/usr/bin:/bin"}
    return subprocess.Popen([sys.executable, "-c", OTHER, *words], env=environment, stdout=subprocess.PIPE, text=True)


def test_a_picture_of_another_program_is_pasted_as_a_layer_and_the_frame_is_copied_for_it(program):
    app = program()
    app.settled()
    with other(app, "give") as giver:
        assert giver.stdout.readline() == "given\n"
        app.move_to((605, 380))  # near the middle of the frame, whose pixel is asked for below
        app.keys("ctrl+v")
        red = app.until(lambda screen: _red(screen).sum() > 3000, (605, 380))
        rows, columns = np.nonzero(_red(red))
        assert 1.4 < np.ptp(columns) / np.ptp(rows) < 1.6  # 120 x 80
        assert abs(rows.mean() + 140 - 380) < 4  # where the pointer was
        assert abs(columns.mean() + 280 - 605) < 4
        giver.kill()
    app.wait_for("where it belongs")
    app.keys("ctrl+shift+c")
    app.wait_for("Copied 1024")
    with other(app, "take") as taker:
        assert taker.communicate(timeout=90)[0].split() == ["1024", "768", "200", "40", "30", "255"]


def test_a_clipboard_without_a_picture_is_told_in_a_line(program):
    app = program()
    app.settled()
    app.do("mousemove", 640, 300)
    app.keys("ctrl+v")
    app.wait_for("clipboard: found no picture on it, expected one")


def _red(screen):
    """Where the canvas is red."""
    screen = screen[140:650, 280:960]
    return (screen[..., 0] > 150) & (screen[..., 1] < 80) & (screen[..., 2] < 80)
