"""Brushes are made ready by processes of their own: in order, each kernel once, and nothing is lost with a process."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from engine.brush.parts import Surface
from engine.brush.settings import Brush
from engine.painting.commands import parse
from engine.studio.preparing import exercise, noted
from engine.studio.preparing.job_queue import (
    FILES,
    LEARNT_DETAIL,
    STRUCTURE,
    WRITTEN_TEXTURES,
    Job,
    JobQueue,
    expected,
    job_of,
)
from engine.studio.preparing.processes import Preparing
from engine.studio.requests import Swatch

ROOT = Path(__file__).parents[3]
# Stands in for a process that compiles: does as the job says, and writes down what it "compiled".
PROGRAM = """
import json, os, sys, time
log = open(sys.argv[1], "a", buffering=1)
def tell(**told):
    print(json.dumps(told), flush=True)
for line in sys.stdin:
    job = json.loads(line)
    while not os.path.exists(sys.argv[1] + job.get("after", "")):
        time.sleep(0.01)
    blocked = ""
    for kernel in job["kernels"]:
        if os.path.exists(sys.argv[1] + kernel):
            continue
        tell(missing=kernel)
        if not json.loads(sys.stdin.readline())["yours"]:
            blocked = kernel
            break
        if job.get("dies"):
            open(sys.argv[1] + "claimed", "w").close()
            os._exit(1)
        time.sleep(job.get("takes", 0.0))
        open(sys.argv[1] + kernel, "w").close()
        log.write(kernel + chr(10))
        tell(saved=kernel)
    tell(done=True, blocked=blocked)
"""


def job(*kernels, **more):
    return Job(json.dumps({"kernels": kernels, **more}))


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    return tmp_path


@pytest.fixture
def make(folder):
    made = []

    def one(processes):
        made.append(Preparing(processes, faults.append, ("-c", PROGRAM, str(folder / "log"))))
        return made[-1]

    faults: list[str] = []
    one.faults = faults
    yield one
    for preparing in made:
        preparing.close()
    # Of these alone: an engine that a test before had stop has some of its own.
    threads = [thread for preparing in made for thread in (*preparing._threads.values(), *preparing._ending)]
    assert not any(thread.is_alive() for thread in threads)


def test_brushes_of_textures_with_a_structure_come_after_what_these_need():
    brushes = {}
    for name, more in (("slow", {"structure": "full"}), ("finer", {"detail": "learnt"}), ("soon", {})):
        texture = parse({"do": "texture", "name": name, "maker": "match", "path": "a.png", **more})
        brushes[name] = Swatch(name, Brush(), (104, 44), textures=(texture,))
    slow, finer, soon = map(job_of, brushes.values())
    assert expected(brushes.values()) == (soon, WRITTEN_TEXTURES, LEARNT_DETAIL, STRUCTURE, slow, finer, FILES)


def compiled(folder, preparing, seconds=90.0):
    """What was compiled, in order, when all is done."""
    end = time.monotonic() + seconds
    while preparing.busy and time.monotonic() < end:
        preparing.wait(0.1)
    assert not preparing.busy
    return (folder / "log").read_text().split()


def test_jobs_are_done_in_order_and_none_twice(folder, make):
    preparing = make(1)
    jobs = [job("a", takes=0.2), job("b"), job("c")]
    preparing.want(jobs)
    preparing.want(jobs)
    assert compiled(folder, preparing) == ["a", "b", "c"]
    assert all(map(preparing.ready, jobs))
    preparing.want(jobs)
    assert not preparing.busy


def test_what_is_picked_jumps_the_queue(folder, make):
    preparing = make(1)
    preparing.want([job("a", after="go"), job("b"), job("c"), job("d")])
    while not preparing._queue.working:
        preparing.wait(0.01)
    preparing.want([job("c")], soon=True)
    preparing.want([job("x")], soon=True)
    (folder / "loggo").touch()
    assert compiled(folder, preparing) == ["a", "x", "c", "b", "d"]


def test_two_processes_compile_no_kernel_twice(folder, make):
    preparing = make(2)
    shared = ["shared1", "shared2"]
    preparing.want([job(*shared, f"own{i}", takes=0.05) for i in range(8)])
    found = compiled(folder, preparing)
    assert sorted(found) == sorted([*shared, *(f"own{i}" for i in range(8))])


def test_a_kernel_that_came_while_it_was_told_as_missing_is_looked_for_again():
    queue, waits = JobQueue(), job("a")
    assert queue.claim("a", 1)
    assert not queue.claim("a", 2)
    queue.compiled("a")
    queue.add([waits], soon=False)
    assert queue.take(urgent=False) == waits
    assert not queue.claim("a", 2)
    queue.put_back(waits, "a")
    assert queue.take(urgent=False) == waits  # at once: nobody compiles it
    assert queue.claim("a", 2)  # and it is not there


def test_while_somebody_paints_one_process_works_unless_a_job_is_waited_for(folder, make):
    preparing = make(2)
    preparing.painting(True)
    preparing.want([job(f"k{i}", takes=0.1) for i in range(6)])
    most = 0
    while preparing.busy:
        preparing.wait(0.05)
        most = max(most, len(preparing._queue.working))
    assert most == 1
    preparing.want([job("u1", after="go"), job("u2", after="go")], soon=True)
    end = time.monotonic() + 90
    while len(preparing._queue.working) < 2:
        assert time.monotonic() < end
        preparing.wait(0.05)
    (folder / "loggo").touch()
    assert set(compiled(folder, preparing)) >= {"u1", "u2"}


def test_a_process_that_dies_costs_its_job_and_no_other(folder, make):
    preparing = make(2)
    bad = job("bad", dies=True)
    # The last comes to the kernel of the one that dies when that one has asked for it, however slow its process is.
    preparing.want([job("a"), bad, job("b"), job("c"), job("bad", "d", after="claimed")])
    assert sorted(compiled(folder, preparing)) == ["a", "b", "bad", "c", "d"]
    assert preparing.ready(bad)
    assert len(make.faults) == 1


def test_what_is_ready_is_remembered(folder, make):
    first, jobs = make(1), [job("a"), job("b")]
    first.want(jobs)
    compiled(folder, first)
    second = make(1)
    second.want(jobs)
    assert not second.busy
    assert second._threads == {}


@pytest.mark.parametrize("text", ["", "{", "[]", '{"for": 1}', '{"for": "STAMP", "ready": 3}', "\udc80"])
def test_a_note_that_is_damaged_or_of_another_version_is_nothing(folder, make, text):
    note = folder / noted.NOTE
    note.write_bytes(text.replace("STAMP", noted.stamp()).encode(errors="surrogateescape"))
    preparing = make(1)
    preparing.want([job("a")])
    assert compiled(folder, preparing) == ["a"]
    assert json.loads(note.read_text())["for"] == noted.stamp()


def test_another_processor_or_numba_has_a_note_of_its_own(monkeypatch):
    from llvmlite import binding

    first = noted.stamp()
    assert noted.stamp() == first
    with monkeypatch.context() as patch:
        patch.setattr(noted, "version", lambda name: "0.1")
        assert noted.stamp() != first
    monkeypatch.setattr(binding, "get_host_cpu_name", lambda: "i486")
    assert noted.stamp() != first


def test_a_change_of_any_module_has_all_noted_anew(tmp_path, monkeypatch):
    """Also of constants that kernels elsewhere take from it: else the engine's thread would compile what counts as
    ready."""
    (tmp_path / "engine" / "room").mkdir(parents=True)
    monkeypatch.setattr(noted, "ROOT", tmp_path)
    stamps = set()
    for text in ("WIDE = 1", "WIDE = 2"):
        (tmp_path / "engine" / "room" / "a.py").write_text(text)
        stamps.add(noted.stamp())
    assert len(stamps) == 2


def test_without_a_folder_to_write_to_nothing_waits(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "none"))
    preparing = Preparing(1, program=("-c", "raise SystemExit(1)"))
    preparing.want([job("a")])
    assert not preparing.busy
    assert preparing.ready(job("a"))


def test_processes_that_cannot_start_leave_nothing_waiting(folder, make):
    preparing = Preparing(2, make.faults.append, ("-c", "raise SystemExit(1)"))
    preparing.want([job("a"), job("b"), job("c")])
    end = time.monotonic() + 90
    while preparing.busy and time.monotonic() < end:
        preparing.wait(0.1)
    assert not preparing.busy
    preparing.close()


KILLED = """
import sys, time
sys.path.insert(0, sys.argv[1])
import engine
from engine.studio.preparing.job_queue import COMMIT
from engine.studio.preparing.processes import Preparing
preparing = Preparing(1, gently=False)
preparing.want([COMMIT])
while preparing.count < 1:
    preparing.wait(1.0)
print(*(process.pid for process in preparing._running), flush=True)
time.sleep(100)
"""
AFTER = """
import sys
sys.path.insert(0, sys.argv[1])
import engine
from engine.kernel_cache import Watch, watched
from engine.studio.preparing import exercise

class Enough(Exception):
    pass

def missing(name):
    print("missing", name)
    raise Enough

try:
    with watched(Watch(missing)):
        exercise.stamped()
except Enough:
    pass
"""


def _alive(pid):
    try:
        text = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return False
    return text.rpartition(")")[2].split()[0] != "Z"


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="looks at processes in /proc")
@pytest.mark.parametrize("brush", [Brush(mode="example", example="a"), Brush(grain=Surface("weave"))])
def test_a_brush_that_names_what_only_a_painting_has_is_no_fault(brush):
    exercise.run(json.loads(job_of(Swatch("", brush, (104, 44))).line))


def test_a_preparation_that_is_killed_leaves_usable_kernels_and_no_process(tmp_path):
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    with subprocess.Popen(
        [sys.executable, "-c", KILLED, str(ROOT)], env=environment, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        children = [int(pid) for pid in process.stdout.readline().split()]
        process.send_signal(signal.SIGKILL)
    assert len(children) == 1
    end = time.monotonic() + 90
    while any(map(_alive, children)) and time.monotonic() < end:
        time.sleep(0.05)
    assert not any(map(_alive, children))
    kept = {path.name for path in tmp_path.rglob("*.kernel")}
    assert kept
    done = subprocess.run(
        [sys.executable, "-c", AFTER, str(ROOT)],
        env=environment,
        capture_output=True,
        text=True,
        timeout=250,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("missing ")
    assert done.stdout.split()[1] not in kept  # the first that it had to compile is one that comes after these
