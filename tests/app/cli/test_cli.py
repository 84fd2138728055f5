"""The command line from outside: exit status, one line for what is wrong, nothing half-written."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from command_line import HEADER, ROOT, start

from app.__main__ import main


def test_help_and_version(capsys):
    for words in (["--help"], ["-h"], ["--version"], ["play", "--help"], ["export", "--help"], ["bench", "-h"]):
        assert main(words) == 0
        assert "inkfall" in capsys.readouterr().out


def test_a_window_without_display_is_one_line(script):
    done = start(script)
    told = done.communicate(timeout=120)[1]
    assert done.returncode == 1
    assert told.count("\n") == 1
    assert "the window cannot be opened" in told


def test_a_reader_that_goes_away_is_one_line(script):
    done = start("play", script, stdout=subprocess.PIPE)
    done.stdout.close()
    done.stdout = None
    told = done.communicate(timeout=120)[1]
    assert done.returncode == 1
    assert told == "inkfall: whoever read standard output has gone\n"


def test_a_full_disk_behind_standard_output_is_one_line(script):
    with open("/dev/full", "w") as full:
        done = start("play", script, stdout=full)
        told = done.communicate(timeout=120)[1]
    assert done.returncode == 1
    assert told.count("\n") == 1


def test_a_process_that_ends_looks_through_nothing(tmp_path):
    """Where the interpreter looks for garbage before it goes: all that was loaded is passed over."""
    told = "import atexit, gc\natexit.register(lambda: print(len(gc.get_objects())))\n"
    (tmp_path / "sitecustomize.py").write_text(told)
    starts = (["-m", "app"], ["-c", "import inkfall_start; inkfall_start.main()"])
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (tmp_path, ROOT, ROOT / "app")))}
    for words in starts:
        done = subprocess.run([sys.executable, *words, "--version"], env=environment, capture_output=True, text=True)
        version, left = done.stdout.split("\n", 1)
        assert version.startswith("inkfall ")
        assert int(left) < 1000


def test_a_damaged_cache_of_kernels_is_cleared(tmp_path):
    """Compiled kernels are read with pickle: a file cut short must not keep the program from working."""
    path = tmp_path / "empty.jsonl"
    path.write_text('{"inkfall": 1, "frame": [0, 0, 8, 8]}\n')
    words = ["play", path, "--png", tmp_path / "o.png"]
    cache = tmp_path / "kernels"
    assert start(*words, stdout=subprocess.DEVNULL, cache=cache).communicate(timeout=120)[1] == ""
    damaged = list(cache.rglob("*.kernel"))
    assert damaged
    for number, file in enumerate(damaged):
        file.write_bytes(file.read_bytes()[: (0, 30, 60)[number % 3]])
    done = start(*words, stdout=subprocess.DEVNULL, cache=cache)
    told = done.communicate(timeout=120)[1]
    assert (done.returncode, told) == (0, "")


def used(pid):
    """Seconds of the processor that a process has had."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def test_an_interrupt_is_one_line_and_leaves_nothing(tmp_path):
    path = tmp_path / "long.jsonl"
    stroke = '{"do": "stroke", "points": [[0, 0], [900, 700]], "brush": {"radius": 300}}\n'
    path.write_text(HEADER + stroke * 3000)
    done = start("play", path, "--save", tmp_path / "o.ora", stdout=subprocess.DEVNULL)
    end = time.monotonic() + 90
    while used(done.pid) < 3.0:  # it paints by now, however slow the machine is
        assert time.monotonic() < end
        time.sleep(0.1)
    done.send_signal(signal.SIGINT)
    told = done.communicate(timeout=120)[1]
    assert done.returncode == 1
    assert told == "inkfall: interrupted; nothing half-written is left\n"
    assert [p.name for p in tmp_path.iterdir()] == ["long.jsonl"]
