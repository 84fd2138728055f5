"""The architecture as a test: imports go only down the list of design units; late imports count."""

import json
import os
import subprocess
import sys
from functools import cache

import pytest

from sources import ROOT, imported, program, unit

# From the bottom to the top.  A unit may import those in the rows above its own here, and itself; units of one row
# do not know one another.
ORDER = (
    ("engine.kernel_cache",),
    ("engine.checks",),
    ("engine.numeric",),
    ("engine.texture", "engine.light"),
    ("engine.brush",),
    ("engine.canvas",),
    ("engine.files",),
    ("engine.solids",),
    ("engine.keeping",),
    ("engine.painting",),
    ("engine.terrain",),
    ("engine.strokes",),
    ("engine.makers",),
    ("engine.archive",),
    ("engine.session",),
    ("engine.journal", "engine.film"),
    ("engine.studio",),
    ("app.input", "app.theme", "app.icons", "app.trace", "app.faults", "app.language"),
    ("app.keys",),
    ("app.canvas",),
    ("app.desk",),
    ("app.actions", "app.tools"),
    ("app.panels",),
    ("app.land",),
    (
        "app.router",
        "app.cursor",
        "app.guide_marks",
        "app.mask_veil",
        "app.solid_view",
        "app.wanted_tiles",
        "app.news",
        "app.pace",
        "app.resting",
        "app.drawing",
    ),
    ("app.callbacks", "app.decoration"),
    ("app.window",),
    ("app.loop",),
    ("app.cli",),
    ("app.__main__",),
    ("app.inkfall_start",),
)
RANK = {unit: rank for rank, units in enumerate(ORDER) for unit in units}
WINDOW = {"glfw", "moderngl", "imgui_bundle", "OpenGL"}
# Modules that may be imported before the window's own thread has anything to show.
LIGHT = {"app", "app.__main__"}


SOURCES = program()


@cache
def names_imported(name: str) -> set[str]:
    return imported(SOURCES[name], SOURCES)


def test_every_module_has_its_place_in_the_order():
    homeless = {name for name in SOURCES if name not in ("engine", "app") and unit(name) not in RANK}
    assert not homeless, f"not in ORDER: {sorted(homeless)}"


def goes_up(name: str, target: str) -> bool:
    """Whether a module imports one that is not below its own unit, nor within it."""
    if target.split(".")[0] not in ("engine", "app") or target in ("engine", "app"):
        return False
    own, other = unit(name), unit(target)
    return other != own and RANK[other] >= RANK.get(own, -1)


def test_imports_go_down_the_list():
    """Of all modules at once, as below: a test for each was a fifth of the suite's tests."""
    assert not [(name, target) for name in sorted(SOURCES) for target in names_imported(name) if goes_up(name, target)]


def test_no_ring_of_modules():
    graph = {name: {t for t in names_imported(name) if t in SOURCES} for name in SOURCES}
    done: set[str] = set()
    trail: list[str] = []

    def walk(name: str) -> None:
        assert name not in trail, " -> ".join([*trail[trail.index(name) :], name])
        if name in done:
            return
        trail.append(name)
        for target in sorted(graph[name]):
            walk(target)
        trail.pop()
        done.add(name)

    for name in sorted(graph):
        walk(name)


def importing(part: str, packages: set[str]) -> list[str]:
    """The modules of a part of the program that import one of some packages."""
    names = sorted(name for name in SOURCES if name.startswith(part))
    assert len(names) > 10
    return [name for name in names if {target.split(".")[0] for target in names_imported(name)} & packages]


def test_the_engine_knows_no_window():
    assert not importing("engine", WINDOW | {"app"})


def test_the_headless_commands_import_no_window_toolkit():
    assert not importing("app.cli", WINDOW)


UNPICKLES = {"engine.kernel_cache"}  # as numba does: what the user's own processes compiled, in a folder of theirs


def test_nothing_is_unpickled():
    for name, module in SOURCES.items():
        if name in UNPICKLES:
            continue
        found = {target.split(".")[0] for target in names_imported(name)} & {"pickle", "marshal", "shelve", "dill"}
        assert not found, f"{name} imports {found}"
        assert "allow_pickle=True" not in module.text, name


def loaded_by(*words: str) -> set[str]:
    """The modules that Python holds after the command line `words` was run, whatever came of it."""
    return loaded_after(f"import app.__main__ as m; m.main({list(words)!r})")


def loaded_after(program: str) -> set[str]:
    """The modules that Python holds after a program."""
    probe = f"{program}\nimport json, sys; print('\\n' + json.dumps(sorted(sys.modules)))"
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    environment.pop("DISPLAY", None)
    done = subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, env=environment, timeout=90)
    assert done.returncode == 0, done.stderr
    return set(json.loads(done.stdout.splitlines()[-1]))


@pytest.mark.parametrize("words", [("info", "no-such.ora"), ("play", "no-such.jsonl"), ("doctor", "--json")])
def test_headless_commands_load_no_window_toolkit(words):
    assert not {name.split(".")[0] for name in loaded_by(*words)} & WINDOW


def test_the_way_to_the_window_loads_nothing_heavy():
    loaded = loaded_by("no-such-file-here.ora")
    assert {name for name in loaded if name.startswith(("app", "engine"))} <= LIGHT | {"app.cli", "app.cli.outcome"}
    assert not {"numpy", "numba", "argparse", "scipy"} & loaded


def test_the_window_is_there_before_what_compiles():
    assert not {name.split(".")[0] for name in loaded_after("import app.window")} & {"numba", "llvmlite", "scipy"}


def test_superpixels_are_loaded_only_where_something_is_found():
    loaded = loaded_after("import app.window, engine.studio.textures.cut_finder, engine.studio.studio")
    assert "skimage" not in {name.split(".")[0] for name in loaded}
