"""The architecture as a test: imports go only down the list of design units; late imports count."""

import ast
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent

# From the bottom to the top.  A unit may import those in the rows above its own here, and itself; units of one row
# do not know one another.
ORDER = (
    ("engine.kernel_cache",),
    ("engine.checks",),
    ("engine.numeric",),
    ("engine.texture",),
    ("engine.brush",),
    ("engine.canvas",),
    ("engine.files",),
    ("engine.painting",),
    ("engine.strokes",),
    ("engine.makers",),
    ("engine.archive",),
    ("engine.session",),
    ("engine.studio",),
    ("app.input", "app.theme", "app.icons", "app.keys", "app.trace", "app.file_guard"),
    ("app.canvas",),
    ("app.desk",),
    ("app.actions", "app.tools"),
    ("app.panels",),
    ("app.router", "app.cursor", "app.news", "app.pace"),
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


def sources() -> dict[str, Path]:
    """Every module of the program by its dotted name."""
    found = {}
    for package in ("engine", "app"):
        for path in sorted((ROOT / package).rglob("*.py")):
            parts = path.relative_to(ROOT).with_suffix("").parts
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


SOURCES = sources()


def imported(name: str) -> set[str]:
    """Dotted names that a module imports anywhere in it: at the top, late, for types, or through import_module."""
    tree = ast.parse(SOURCES[name].read_text())
    package = name.split(".") if SOURCES[name].name == "__init__.py" else name.split(".")[:-1]
    out: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            out.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                base = ".".join([*package[: len(package) - node.level + 1], *([base] if base else [])])
            out.update(f"{base}.{alias.name}" if f"{base}.{alias.name}" in SOURCES else base for alias in node.names)
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in (
            "import_module",
            "__import__",
        ):
            out.update(a.value for a in node.args[:1] if isinstance(a, ast.Constant) and isinstance(a.value, str))
    return out


def unit(name: str) -> str:
    return ".".join(name.split(".")[:2])


def test_every_module_has_its_place_in_the_order():
    homeless = {name for name in SOURCES if name not in ("engine", "app") and unit(name) not in RANK}
    assert not homeless, f"not in ORDER: {sorted(homeless)}"


@pytest.mark.parametrize("name", sorted(SOURCES))
def test_imports_go_down_the_list(name):
    own = unit(name)
    for target in imported(name):
        if target.split(".")[0] not in ("engine", "app") or target in ("engine", "app"):
            continue
        other = unit(target)
        assert other == own or RANK[other] < RANK.get(own, -1), f"{name} imports {target}"


def test_no_ring_of_modules():
    graph = {name: {t for t in imported(name) if t in SOURCES} for name in SOURCES}
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


@pytest.mark.parametrize("name", sorted(name for name in SOURCES if name.startswith("engine")))
def test_the_engine_knows_no_window(name):
    assert not {target.split(".")[0] for target in imported(name)} & (WINDOW | {"app"})


@pytest.mark.parametrize("name", sorted(name for name in SOURCES if name.startswith("app.cli")))
def test_the_headless_commands_import_no_window_toolkit(name):
    assert not {target.split(".")[0] for target in imported(name)} & WINDOW


UNPICKLES = {"engine.kernel_cache"}  # as numba does: what the user's own processes compiled, in a folder of theirs


def test_nothing_is_unpickled():
    for name, path in SOURCES.items():
        if name in UNPICKLES:
            continue
        found = {target.split(".")[0] for target in imported(name)} & {"pickle", "marshal", "shelve", "dill"}
        assert not found, f"{name} imports {found}"
        assert "allow_pickle=True" not in path.read_text(), name


def loaded_by(*words: str) -> set[str]:
    """The modules that Python holds after the command line `words` was run, whatever came of it."""
    probe = (
        f"import json, sys, app.__main__ as m\nm.main({list(words)!r})\nprint('\\n' + json.dumps(sorted(sys.modules)))"
    )
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    environment.pop("DISPLAY", None)
    done = subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, env=environment, timeout=60)
    assert done.returncode == 0, done.stderr
    return set(json.loads(done.stdout.splitlines()[-1]))


@pytest.mark.parametrize("words", [("info", "no-such.ora"), ("play", "no-such.jsonl"), ("doctor", "--json")])
def test_headless_commands_load_no_window_toolkit(words):
    assert not {name.split(".")[0] for name in loaded_by(*words)} & WINDOW


def test_the_way_to_the_window_loads_nothing_heavy():
    loaded = loaded_by("no-such-file-here.ora")
    assert {name for name in loaded if name.startswith(("app", "engine"))} <= LIGHT | {"app.cli", "app.cli.outcome"}
    assert not {"numpy", "numba", "argparse", "scipy"} & loaded
