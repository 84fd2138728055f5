"""The real window starts on a home of which every file is damaged: settings, brushes, examples, entries, versions, and
by night the cache of kernels, too.

INKFALL_DAMAGES: how many homes by night; INKFALL_DAMAGES_SEED: of what is random.
"""

import os
import random
import shutil

import pytest
from damaged_home import damage, damaged_cache, make_home
from driven import REST

from engine.archive.opening import open_painting
from engine.painting import commands as c

pytestmark = pytest.mark.window
COUNT = int(os.environ.get("INKFALL_DAMAGES", "100"))
SEED = int(os.environ.get("INKFALL_DAMAGES_SEED", "1"))
FRESH = 20  # of so many, one starts with a damaged cache
COMPILED = 900.0  # seconds in which what is missing of that is compiled, whatever else the machine does


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """The home, whole."""
    folder = tmp_path_factory.mktemp("home")
    with pytest.MonkeyPatch.context() as patch:
        for name in ("config", "data", "state"):
            patch.setenv(f"XDG_{name.upper()}_HOME", str(folder / name))
        for name in ("LIMIT", "PAUSE_FACTOR", "PICTURE_PAUSE"):
            patch.setattr(f"engine.studio.journalled.beside.{name}", 1e-9)
        patch.setattr("engine.studio.preparing.processes.Preparing.busy", False)
        make_home(folder)
    return folder


def starts(program, folder, **how):
    """The window comes up, a stroke is painted and saved; nothing is told of but by a line."""
    app = program(**how)
    app.wait_for("cards: ")
    if "cards: 0" not in app.log.read_text():
        app.keys("Escape")
        app.until_gone("Open")
    app.move_to(REST)
    app.until_rest(REST)
    app.stroke((500, 400), (620, 430), (560, 520))
    app.wait_for("a stroke is posted")
    app.save_as(folder / "saved.ora")
    drawn = [one for one in open_painting(folder / "saved.ora").recording.commands if isinstance(one, c.Stroke)]
    assert len(drawn) == 1
    assert "Traceback" not in (folder / "state/inkfall/log/inkfall.log").read_text(errors="replace")


@pytest.mark.nightly
@pytest.mark.parametrize("cuts", [True, False], ids=["cut", "flipped"])
def test_it_starts_on_a_damaged_home(program, home, tmp_path, cuts):
    shutil.copytree(home, tmp_path, dirs_exist_ok=True)
    assert damage(tmp_path, random.Random(7), cuts) > 20
    starts(program, tmp_path)


@pytest.mark.nightly
@pytest.mark.timeout(2 * COMPILED)
@pytest.mark.parametrize("number", range(COUNT))
def test_it_starts_on_many_damaged_homes(program, home, tmp_path, monkeypatch, number):
    chance, fresh = random.Random(1000 * SEED + number), number % FRESH == FRESH - 1
    shutil.copytree(home, tmp_path, dirs_exist_ok=True)
    damage(tmp_path, chance, number % 2 == 0)
    if fresh:
        damaged_cache(tmp_path / "cache", chance, number % 4 == 0)
        monkeypatch.setattr("driven.PATIENCE", COMPILED)
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
        monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    starts(program, tmp_path, fresh=fresh)
