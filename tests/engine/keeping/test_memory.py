"""The budget of memory: what it is when who says so, and free pages that go back to the system."""

import mmap
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from engine.keeping import memory
from engine.keeping.preferences import preferences_file
from engine.studio.filing.beginning import begun


@pytest.fixture
def preferring(tmp_path, monkeypatch):
    """Writes preferences, which this test alone reads."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))

    def prefer(megabytes):
        preferences_file().parent.mkdir(parents=True, exist_ok=True)
        preferences_file().write_text(f"[memory]\nmegabytes = {megabytes}\n")

    return prefer


def test_the_variable_counts_before_the_preferences_and_these_before_the_machine(preferring):
    fitting, fault = memory.told_budget(None)
    assert 0 < fitting <= 4096 << 20
    assert fault == ""
    preferring(0)
    assert memory.told_budget(None) == (fitting, "")
    preferring(900)
    assert memory.told_budget(None) == (900 << 20, "")
    assert memory.told_budget("512") == (512 << 20, "")
    assert memory.told_budget("1") == (64 << 20, "")


@pytest.mark.parametrize("word", ["", "much", "-1", "1.5", "9" * 30, "\n"])
def test_what_is_wrong_is_told_and_changes_nothing(preferring, word):
    preferring(900)
    found, fault = memory.told_budget(word)
    assert found == 900 << 20
    assert fault.startswith("INKFALL_MEMORY: found ")
    assert "\n" not in fault


def test_the_window_is_told_what_is_wrong(tmp_path, monkeypatch):
    sent = []
    for name in ("XDG_CONFIG_HOME", "XDG_STATE_HOME"):
        monkeypatch.setenv(name, str(tmp_path))
    for word in ("512", "much"):
        monkeypatch.setenv(memory.VARIABLE, word)
        begun(sent.append)
    assert [(note.text, note.stays) for note in sent] == [(memory.told_budget("much")[1], True)]


def test_all_shares_together_leave_room_for_the_painting_itself():
    shares = memory.cache_share(), memory.history_share(), memory.states_share()
    assert sum(shares) <= memory.budget() * 3 // 4


def told_by_the_system():
    with Path("/proc/self/statm").open() as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="others do not tell it so")
def test_each_process_is_told_its_own_memory():
    held = np.ones(64 << 20, np.uint8)
    before, found, after = (
        told_by_the_system(),
        memory.resident(),
        told_by_the_system(),
    )  # which may take some meanwhile
    assert min(before, after) - (4 << 20) < found < max(before, after) + (4 << 20)
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        begun = memory.resident()  # less than before: pages of files are not its own yet
        taken = mmap.mmap(-1, 200 << 20)  # pages of its own, not free ones of the heap, which count already
        taken.write(bytes(200 << 20))
        os.write(writer, str(memory.resident() - begun).encode())
        os._exit(taken[0])
    assert os.waitpid(child, 0)[1] == 0
    assert int(os.read(reader, 100)) > 150 << 20
    for end in (reader, writer):
        os.close(end)
    assert held.all()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only glibc keeps pages and gives them back")
def test_free_pages_go_back_to_the_system():
    program = """
import numpy as np
from engine.keeping import memory
held = [np.ones(60_000, np.uint8) for _ in range(4000)]  # on the heap
held = held[::200]
before = memory.resident()
memory.give_back()
print(before - memory.resident())
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert int(done.stdout) > 150 << 20
