"""The dialog for films: a picture of the film, the film itself while one paints on, and one that is given up."""

import time

import numpy as np
import pytest
from PIL import Image

pytestmark = [pytest.mark.window, pytest.mark.timeout(480)]  # three films, and kernels that may be compiled for them
RED = np.array([200, 40, 30])
LINES = (
    '{"inkfall": 1, "frame": [0, 0, 640, 360], "seed": 7}\n'
    '{"do": "stroke", "points": [[0, 180], [640, 180]], '
    '"brush": {"radius": 120, "colour": "#c8281e", "dynamics": {}}}\n'
)


def films_to(program, path):
    """Chooses a file in the dialog."""
    program.click("Choose file…")
    program.box("name", "Film")
    program.fill(str(path))
    time.sleep(1.0)
    program.keys("Return")


@pytest.mark.nightly
def test_a_film_of_the_painting(program, tmp_path):
    (tmp_path / "a.jsonl").write_text(LINES)
    window = program(str(tmp_path / "a.jsonl"))
    end = time.monotonic() + 90
    while (np.abs(window.screen() - RED).max(axis=2) < 6).sum() < 10_000:
        assert time.monotonic() < end
        time.sleep(0.2)

    window.keys("ctrl+shift+e")
    part = window.part("film picture")
    window.until(lambda screen: (np.abs(screen[part] - RED).max(axis=2) < 6).mean() > 0.4)
    # Nearer: nothing but paint is to be seen in the end, and the frame at the beginning.
    window.keys("Escape")
    window.until_gone("film picture")
    window.do("mousemove", 600, 400)
    window.wheel(16)
    window.settled()
    window.keys("ctrl+shift+e")
    window.click("Flight")
    part = window.part("film picture")
    window.until(lambda screen: (np.abs(screen[part] - RED).max(axis=2) < 6).mean() > 0.97)
    window.click(window.at("moment", across=0.01))
    window.until(lambda screen: 0.4 < (np.abs(screen[part] - RED).max(axis=2) < 6).mean() < 0.9)

    film = tmp_path / "flight.gif"
    window.click("24")  # frames a second, fewer than usual
    films_to(window, film)
    window.box("Stop film")
    window.stroke((500, 300), (700, 500))  # painting goes on
    end = time.monotonic() + 180
    while not film.exists():
        assert time.monotonic() < end
        time.sleep(0.1)
    with Image.open(film) as made:
        assert made.size == (1280, 720)
        assert made.n_frames > 20  # those alike are one
        made.seek(made.n_frames - 1)
        assert (np.abs(np.asarray(made.convert("RGB")).astype(int) - RED).max(axis=2) < 12).mean() > 0.9

    window.until_gone("Stop film")  # the window hears of it a moment later
    window.keys("ctrl+shift+e")
    window.click("How it was made")
    window.click(window.at("seconds", across=0.95))
    films_to(window, tmp_path / "long.gif")
    window.click("Stop film")
    window.until_gone("Stop film")

    # Closing the window asks about a film that is being made.
    window.keys("ctrl+shift+e")
    films_to(window, tmp_path / "long.gif")
    window.box("Stop film")
    window.keys("ctrl+q")
    window.box("Wait")
    window.keys("Escape")
    window.until_gone("Wait")
    window.keys("ctrl+q")
    window.click("Give it up")
    window.click("Don’t save")
    assert window.process.wait(90) == 0
    assert sorted(path.name for path in tmp_path.iterdir() if path.suffix in (".gif", ".part")) == ["flight.gif"]
