"""The wheel holds the program and nothing else, and what it installs runs wherever it is started."""

import json
import os
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FOLDERS = {"app": {".py"}, "engine": {".py", ".html"}, "shaders": {".vert", ".frag"}}
SHORT = """{"inkfall": 1, "frame": [0, 0, 256, 256], "seed": 7}
{"do": "stroke", "points": [[20, 40], [230, 200]], "brush": {"radius": 24}}
"""
PALETTES = {".json", ".jsonl", ".png", ".toml", ".md", ".txt", ".po", ".mo", ".otf"}


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """Built from the checkout as `pip install .` builds it, by what is installed here."""
    pytest.importorskip("hatchling")
    folder = tmp_path_factory.mktemp("wheel")
    subprocess.run([sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", folder], cwd=ROOT, check=True)
    return next(folder.glob("*.whl"))


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    """The folder of an environment's programs that has the wheel, and sees this one's packages but not its code."""
    folder = tmp_path_factory.mktemp("installed")
    venv.create(folder)
    packages = next(folder.rglob("site-packages"))
    seen = [path for path in sys.path if Path(path).name in ("site-packages", "dist-packages")]
    (packages / "seen.pth").write_text("\n".join(seen))
    programs = folder / ("Scripts" if os.name == "nt" else "bin")
    python = programs / "python"
    pip = [sys.executable, "-m", "pip", "--python", python, "--disable-pip-version-check", "install", "-q"]
    subprocess.run([*pip, "--no-deps", "--no-index", "--ignore-installed", wheel], check=True)
    return programs


@pytest.fixture(scope="module")
def stranger(tmp_path_factory):
    """A folder whose `app` and `engine` are somebody else's."""
    folder = tmp_path_factory.mktemp("stranger")
    for name in ("app", "engine"):
        (folder / name).mkdir()
        (folder / name / "__init__.py").write_text("")
    return folder


def started(*command, cwd, **variables):
    environment = {**os.environ, **variables}
    environment.pop("DISPLAY", None)
    return subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True)


def test_it_holds_the_program_and_nothing_else(wheel):
    names = [name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name]
    assert [name for name in names if "/" not in name] == ["inkfall_start.py"]
    assert {name.partition("/")[0] for name in names if "/" in name} == {*FOLDERS, "palettes"}
    for folder, endings in FOLDERS.items():
        held = {name for name in names if name.startswith(f"{folder}/")}
        there = {path.relative_to(ROOT).as_posix() for path in (ROOT / folder).rglob("*") if path.suffix in endings}
        assert held == there - {"app/inkfall_start.py"}
    palettes = {Path(name) for name in names if name.startswith("palettes/")}
    assert {path.suffix for path in palettes} == PALETTES
    assert Path("palettes/demo/demo.jsonl") in palettes
    assert not [path for path in palettes if path.parts[1] == "pictures"]


def demo(installed, folder):
    """What `inkfall demo --out` writes, as the installed program tells and as it lies in the folder."""
    done = started(installed / "inkfall", "demo", "--out", "out", "--json", cwd=folder)
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)["written"]
    assert sorted(Path(name).name for name in told) == sorted(path.name for path in (folder / "out").iterdir())
    return folder / "out"


@pytest.mark.timeout(600)
def test_a_demo_is_painted(installed, tmp_path):
    """With a short recording in place of the bundled one, whose kernels may all have to be compiled."""
    recording = next(installed.parent.rglob("palettes/demo/demo.jsonl"))
    whole = recording.read_text()
    try:
        recording.write_text(SHORT)
        assert (demo(installed, tmp_path) / "demo.png").stat().st_size > 1000
    finally:
        recording.write_text(whole)


@pytest.mark.nightly
@pytest.mark.timeout(900)
def test_the_demo_is_painted(installed, tmp_path):
    assert (demo(installed, tmp_path) / "demo.png").stat().st_size > 1000


@pytest.mark.parametrize("path", ["", "."])
def test_no_folder_of_a_stranger_is_taken_for_ours(installed, stranger, path):
    """In the working directory, and named by PYTHONPATH too."""
    done = started(installed / "inkfall", "--version", cwd=stranger, PYTHONPATH=path and str(stranger))
    assert (done.returncode, done.stderr) == (0, "")
    done = started(installed / "inkfall", "info", "no-such.ora", cwd=stranger, PYTHONPATH=path and str(stranger))
    assert done.returncode == 2
    assert done.stderr.startswith("inkfall: no-such.ora: ")


@pytest.mark.parametrize("path", ["", "."])
def test_neither_by_the_processes_that_it_starts(installed, stranger, path):
    """As the program starts its own: by `sys.executable -m`."""
    child = (
        "import inkfall_start, subprocess, sys\n"
        "sys.argv = ['inkfall', '--version']\n"
        "inkfall_start.main()\n"
        "sys.exit(subprocess.run([sys.executable, '-m', 'app', 'info', 'no-such.ora']).returncode)"
    )
    done = started(installed / "python", "-c", child, cwd=stranger, PYTHONPATH=path and str(stranger))
    assert done.returncode == 2
    assert done.stderr.startswith("inkfall: no-such.ora: ")


def test_benchmarks_come_with_the_source(installed, tmp_path):
    done = started(installed / "inkfall", "bench", cwd=tmp_path)
    assert done.returncode == 1
    assert done.stderr == "inkfall: bench: benchmarks come with the source: run `python -m app bench` in its folder\n"


def test_the_checkout_runs_as_it_is(tmp_path):
    done = started(sys.executable, "-m", "app", "--version", cwd=ROOT)
    assert (done.returncode, done.stderr) == (0, "")
