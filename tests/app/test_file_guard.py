"""The guard of the window's thread tells what that thread opens, and nothing else."""

import os
import subprocess
import sys
from pathlib import Path

from app.faults.file_guard import TOLD

ROOT = Path(__file__).parents[2]
PROBE = """
import sys, threading
from pathlib import Path
from app.faults.file_guard import guard_files
Path("before").write_text("")
guard_files()
other = threading.Thread(target=lambda: Path("by another").write_text(""))
other.start()
other.join()
import colorsys  # what Python itself reads
open("/proc/self/stat").close()
Path("read").open("w").close()
Path("read").rename("moved")
Path("moved").unlink()
"""


def told(folder, trace):
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "INKFALL_TRACE": trace, "PYTHONDONTWRITEBYTECODE": "1"}
    words = [sys.executable, "-c", PROBE]
    done = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True, timeout=90, check=True)
    return done.stderr.splitlines()


def test_what_the_guarded_thread_opens_moves_and_removes_is_told(tmp_path):
    lines = told(tmp_path, "1")
    assert [line.split(",")[0] for line in lines] == [
        f"{TOLD} open read",
        f"{TOLD} os.rename read",
        f"{TOLD} os.remove moved",
    ]


def test_without_the_switch_nothing_is_told(tmp_path):
    assert told(tmp_path, "") == []
