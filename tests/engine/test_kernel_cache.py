"""Compiled kernels are kept whole, for what they depend on, and wherever that is possible."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numba
import pytest

from engine import kernel_cache

ROOT = Path(__file__).parents[2]
TOY = "from numba import njit\n@njit(cache=True)\ndef double(x):\n    return 2 * x\n"
PROGRAM = """
import sys
sys.path[:0] = sys.argv[1:3]
import engine, numba
numba.config.reload_config()  # it was there before the engine told it where kernels are kept
import toy
print(toy.double(21), sum(toy.double.stats.cache_hits.values()))
"""
RUNTIME = """
import sys
sys.path[:0] = sys.argv[1:3]
import engine
from numba.core.runtime import nrtdynmod
made, create = [], nrtdynmod.create_nrt_module
nrtdynmod.create_nrt_module = lambda context: made.append(context) or create(context)
import numpy, toy
print(toy.double(numpy.arange(3.0)).sum(), len(made))
"""
# Runs a program for each line that it reads, in a process that has loaded numba already, and nothing of the engine.
SERVER = """
import json, os, sys
import numba
numba.njit(lambda x: x + 1)(1)  # what it sets up for the first
for line in sys.stdin:
    told = json.loads(line)
    child = os.fork()
    if child == 0:
        os.environ.clear()
        os.environ.update(told["environment"])
        os.chdir(told["folder"])
        for number, name in ((1, "out"), (2, "error")):
            os.dup2(os.open(name, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600), number)
        sys.argv[1:] = told["words"]
        exec(told["program"], {"__name__": "__main__"})
        break
    os.write(1, b"%d\\n" % os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


class Toy:
    """A kernel in a folder of its own, called by a new process each time, which `server` forks off."""

    def __init__(self, folder: Path, server: "subprocess.Popen[str]") -> None:
        self._server = server
        self.folder, self.cache, self.home = folder, folder / "cache", folder / "home"
        self.environment = {**os.environ, "XDG_CACHE_HOME": str(self.home), "NUMBA_CACHE_DIR": str(self.cache)}
        self.write(TOY)

    def write(self, text: str) -> None:
        (self.folder / "toy.py").write_text(text)
        os.utime(self.folder / "toy.py", (1e9, 1e9))  # as installed from a wheel, where every version has the same

    def call(self, program: str = PROGRAM) -> list[int]:
        """The result, and how many kernels came from the cache."""
        words, place = [str(ROOT), str(self.folder)], str(self.folder)
        told = {"program": program, "words": words, "folder": place, "environment": self.environment}
        self._server.stdin.write(f"{json.dumps(told)}\n")
        self._server.stdin.flush()
        status = self._server.stdout.readline()
        error = (self.folder / "error").read_text()
        assert (status, error) == ("0\n", "")
        return [int(word) for word in (self.folder / "out").read_text().split()]

    def kernels(self) -> list[Path]:
        return sorted(self.folder.rglob(f"*{kernel_cache.ENDING}"))


@pytest.fixture(scope="module")
def server():
    command = [sys.executable, "-B", "-c", SERVER]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        yield process
        process.stdin.close()


@pytest.fixture
def toy(tmp_path, server):
    return Toy(tmp_path, server)


def test_a_kernel_is_compiled_once(toy):
    assert toy.call() == [42, 0]
    assert toy.call() == [42, 1]
    assert len(toy.kernels()) == 1
    assert toy.kernels()[0].is_relative_to(toy.cache)


def test_what_counts_references_is_compiled_once(toy):
    for made in (1, 0):
        command = [sys.executable, "-B", "-c", RUNTIME, str(ROOT), str(toy.folder)]
        told = subprocess.run(command, env=toy.environment, capture_output=True, text=True, check=True)
        assert told.stdout.split() == ["6.0", str(made)]
    assert [path.name.partition(".")[0] for path in toy.cache.iterdir() if path.is_file()] == ["references"]


NIGHTLY = [pytest.param(damage, marks=pytest.mark.nightly) for damage in ("empty", "flipped")]


@pytest.mark.parametrize("damage", ["half", "no pickle", *NIGHTLY])
def test_a_damaged_one_is_made_anew(toy, damage):
    toy.call()
    (path,) = toy.kernels()
    whole = path.read_bytes()
    middle = len(whole) // 2
    path.write_bytes(
        {
            "empty": b"",
            "half": whole[:middle],
            "flipped": whole[:middle] + bytes([whole[middle] ^ 1]) + whole[middle + 1 :],
            "no pickle": b"x" * 5000,
        }[damage]
    )
    assert toy.call() == [42, 0]
    assert toy.call() == [42, 1]


def test_numbas_own_files_beside_it_are_left_alone(toy):
    toy.call()
    (path,) = toy.kernels()
    other = path.with_name("toy.double-2.py311.nbi")
    other.write_bytes(b"torn")
    assert toy.call() == [42, 1]


def test_other_source_of_the_same_size_and_age_is_another_kernel(toy):
    assert toy.call() == [42, 0]
    toy.write(TOY.replace("2 * x", "3 * x"))
    assert toy.call() == [63, 0]
    toy.write(TOY)
    assert toy.call() == [42, 1]


@pytest.mark.parametrize(
    "other", ["numba.__version__ = '0.0'", "import llvmlite.binding as b; b.get_host_cpu_name = lambda: 'i486'"]
)
def test_another_numba_or_processor_has_kernels_of_its_own(toy, other):
    assert toy.call() == [42, 0]
    if "numba" in other:
        assert toy.call(PROGRAM.replace("import engine", f"import numba; {other}; import engine")) == [42, 0]
    else:
        key = ("(int64,)", ("x86_64", "i486", ""), ("a", "b"))
        file = kernel_cache.KernelFile("folder", "toy.double", "stamp")
        assert file.path(key) != file.path((key[0], ("x86_64", "znver3", ""), key[2]))
    assert toy.call() == [42, 1]


def test_a_folder_that_cannot_be_written_to_is_done_without(toy):
    toy.cache.write_text("a file where the folder would be: nobody, root neither, can write into it")
    assert toy.call() == [42, 0]
    assert toy.call() == [42, 0]
    assert not toy.kernels()


def test_a_home_that_cannot_be_written_to_leaves_nothing_behind(toy):
    del toy.environment["NUMBA_CACHE_DIR"]
    toy.home.write_text("no folder")
    (toy.folder / "tmp").mkdir()
    toy.environment["TMPDIR"] = str(toy.folder / "tmp")
    assert toy.call() == [42, 0]
    assert list((toy.folder / "tmp").iterdir()) == []


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="the system has no such modes")
def test_kernels_that_others_could_write_are_not_read(toy):
    del toy.environment["NUMBA_CACHE_DIR"]
    folder = toy.home / "inkfall" / "kernels"
    folder.mkdir(parents=True)
    folder.chmod(0o777)
    assert toy.call() == [42, 0]
    assert not toy.kernels()
    folder.chmod(0o700)
    toy.call()
    assert toy.kernels()


def test_what_a_module_imports_of_the_engine_is_part_of_it(tmp_path, monkeypatch):
    package = tmp_path / "engine"
    (package / "room").mkdir(parents=True)
    monkeypatch.setattr(kernel_cache, "_PACKAGE", package)

    def stamp(**texts: str) -> str:
        for name, text in texts.items():
            (package / "room" / f"{name}.py").write_text(text)
        for kept in (kernel_cache.stamp, kernel_cache._source, kernel_cache._imported):
            kept.cache_clear()
        return kernel_cache.stamp(package / "room" / "a.py")

    first = stamp(
        a="from engine.room import b\n",
        b="from engine.room.c import (\n    X,\n    Y,\n)\n",
        c="X = Y = 1\n",
        d="Z = 1\n",
    )
    assert stamp(d="Z = 2\n") == first
    assert stamp(c="X = Y = 2\n") != first
    assert stamp(c="X = Y = 1\n") == first
    assert stamp(b="from engine.room.d import Z\n") != first


def test_copies_of_the_engine_share_their_kernels(toy, tmp_path, monkeypatch):
    """A checkout, another one, and what a wheel installs: what differs in them has another stamp."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", "kernels")

    def kept(file: Path, package: Path) -> str:
        monkeypatch.setattr(kernel_cache, "_PACKAGE", package)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(TOY)
        return kernel_cache.Locator.from_function(kept, str(file)).get_cache_path()

    one, other, engine = tmp_path / "one", tmp_path / "other", Path("engine")
    first = kept(one / "engine" / "room" / "a.py", one / engine)
    assert kept(other / "engine" / "room" / "a.py", other / engine) == first
    assert kept(one / "engine" / "hall" / "a.py", one / engine) != first
    assert kept(one / "palettes" / "room" / "a.py", one / engine) != kept(
        other / "palettes" / "room" / "a.py", one / engine
    )


def test_a_thread_may_refuse_to_compile(toy):
    program = """
import sys
sys.path[:0] = sys.argv[1:3]
import engine, numba
numba.config.reload_config()
import toy
from engine import kernel_cache
told = []
try:
    with kernel_cache.refusing():
        toy.double(21)
except kernel_cache.NotCompiled as error:
    told.append(error.name)
with kernel_cache.watched(kernel_cache.Watch(told.append, told.append)):
    assert toy.double(21) == 42
    toy.double(22)
assert told[0].startswith("toy.double-") and set(told) == {told[0]}, told
with kernel_cache.refusing():
    print(toy.double(21), len(told))
"""
    assert toy.call(program) == [42, 3]
