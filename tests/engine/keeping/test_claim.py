"""A file is claimed by one process at a time, and by none that is gone."""

import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from engine.keeping.claim import claim, forget_unclaimed, turn
from engine.keeping.state_folder import state_folder

ROOT = Path(__file__).resolve().parents[3]
HOLDS = """
import sys, time
from pathlib import Path
from engine.keeping.claim import claim
print(claim(Path(sys.argv[1])) is not None, flush=True)
time.sleep(600)
"""


@pytest.fixture(autouse=True)
def state(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


def left():
    return [path.name for path in state_folder("open").iterdir()]


def test_a_file_is_claimed_once_until_it_is_given_up():
    held = claim(Path("/a"))
    assert held is not None
    assert claim(Path("/a")) is None
    other = claim(Path("/b"))
    assert other is not None
    other.release()
    held.release()
    held.release()
    again = claim(Path("/a"))
    assert again is not None
    again.release()
    assert left() == []


def test_the_claim_of_a_killed_process_is_free_and_its_lock_is_swept():
    child = subprocess.Popen([sys.executable, "-c", HOLDS, "/a"], stdout=subprocess.PIPE, cwd=ROOT)
    assert child.stdout.readline() == b"True\n"
    forget_unclaimed()
    assert claim(Path("/a")) is None
    child.send_signal(signal.SIGKILL)
    child.wait()
    child.stdout.close()
    assert len(left()) == 1
    forget_unclaimed()
    assert left() == []
    claim(Path("/a")).release()


def test_many_at_once_never_hold_it_together():
    inside, most, lock = [], [], threading.Lock()

    def work():
        for _ in range(60):
            with turn(Path("/a")):
                inside.append(1)
                with lock:
                    most.append(len(inside))
                inside.pop()

    threads = [threading.Thread(target=work) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(most) == 360
    assert max(most) == 1


def test_without_a_state_folder_every_window_has_it(tmp_path):
    (tmp_path / "state").write_text("no folder")
    one, two = claim(Path("/a")), claim(Path("/a"))
    assert one is not None
    assert two is not None
    one.release()
    two.release()
