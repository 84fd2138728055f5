"""What a killed process left beside the file that it wrote is gone after the next start."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from engine.keeping.state_folder import state_folder
from engine.keeping.unfinished import sweep_unfinished, unfinished

ROOT = Path(__file__).resolve().parents[3]
WRITES = """
import sys, time
from pathlib import Path
from engine.files.atomic import replacing
from engine.keeping.unfinished import unfinished
with unfinished(Path(sys.argv[1])), replacing(sys.argv[1]) as file:
    file.write(b"half")
    file.flush()
    print("half", flush=True)
    time.sleep(600)
"""


@pytest.fixture(autouse=True)
def state(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "paintings").mkdir()
    return tmp_path / "paintings"


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_a_killed_save_leaves_nothing_and_one_that_goes_on_is_left_alone(folder):
    (folder / "link.ora").symlink_to("lake.ora")
    child = subprocess.Popen([sys.executable, "-c", WRITES, folder / "link.ora"], stdout=subprocess.PIPE, cwd=ROOT)
    child.stdout.readline()
    assert len(names(folder)) == 2
    assert sweep_unfinished() == 0
    assert len(names(folder)) == 2
    child.send_signal(signal.SIGKILL)
    child.wait()
    child.stdout.close()
    assert sweep_unfinished() == 1
    assert names(folder) == ["link.ora"]
    assert names(state_folder("writing")) == []


def test_what_a_killed_film_of_numbered_pictures_left_is_gone(folder):
    code = "import sys, time\nfrom pathlib import Path\nfrom engine.files.atomic import part_folder\n"
    code += "from engine.keeping.unfinished import unfinished\npath = Path(sys.argv[1])\nwith unfinished(path):\n"
    code += "    (part_folder(path) / 'lake-1.png').write_bytes(b'1')\n    print('1', flush=True)\n    time.sleep(600)"
    with subprocess.Popen(
        [sys.executable, "-c", code, folder / "lake-%d.png"], stdout=subprocess.PIPE, cwd=ROOT
    ) as child:
        child.stdout.readline()
        assert sweep_unfinished() == 0
        assert len(names(folder)) == 1
        child.kill()
    assert sweep_unfinished() == 1
    assert names(folder) == []


def test_it_is_swept_too_where_another_process_has_the_number_now(folder):
    part = folder / f".lake.ora.{os.getppid()}.0123abcd.part"
    part.write_bytes(b"half")
    told = {"path": str(folder / "lake.ora"), "process": os.getppid()}
    (state_folder("writing") / "1-a.json").write_text(json.dumps(told))
    assert sweep_unfinished() == 1
    assert names(folder) == []


def test_a_folder_that_is_away_is_waited_for(tmp_path):
    record = state_folder("writing") / "1-a.json"
    record.write_text(json.dumps({"path": str(tmp_path / "stick" / "lake.ora"), "process": 1}))
    sweep_unfinished()
    assert record.exists()
    long_ago = time.time() - 40 * 86400
    os.utime(record, (long_ago, long_ago))
    sweep_unfinished()
    assert not record.exists()


@pytest.mark.parametrize("data", ["", "{", "[]", '{"path": 3}', '{"path": "/a\\u0000b", "process": 1}', "[" * 9000])
def test_a_torn_record_is_taken_away(data):
    record = state_folder("writing") / "1-a.json"
    record.write_text(data)
    assert sweep_unfinished() == 0
    assert not record.exists()


def test_nothing_is_left_after_a_save(folder):
    with unfinished(folder / "lake.ora"):
        assert len(names(state_folder("writing"))) == 1
    assert names(state_folder("writing")) == []


def test_without_a_state_folder_it_is_written_all_the_same(tmp_path):
    (tmp_path / "state").write_text("no folder")
    with unfinished(tmp_path / "lake.ora"):
        pass
