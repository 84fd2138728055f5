"""The house does not get worse: no count of `counts.py` is above what `counts.json` allows."""

import json

import pytest

from counts import COUNTED, FORCED, METHODS, STORED, House, counted, counts_of, table, worse

GOOD = '''
from typing import Any
def reach(radius: float) -> float:
    """How far it goes."""
    return radius
'''


@pytest.fixture(scope="module")
def whole():
    return House()


@pytest.fixture(scope="module")
def now(whole):
    return counts_of(whole)


@pytest.fixture(scope="module")
def stored():
    return json.loads(STORED.read_text())


@pytest.mark.parametrize("name", COUNTED)
def test_no_count_is_worse_than_it_was(now, stored, name):
    assert not [line for line in worse(now, stored["allowed"]) if line.startswith(f"{name}:")]


def test_every_count_has_a_number(stored):
    assert set(stored["allowed"]) == set(COUNTED)
    assert set(COUNTED) <= set(stored["before"])


def test_each_exception_is_needed(whole):
    held = {f"{module.name}.{node.name}" for module, node in whole._classes}
    assert set(FORCED) <= held
    assert METHODS == 15


def house(tmp_path, **modules):
    """A house of modules by their names, __ for a dot."""
    for package in ("engine", "app"):
        (tmp_path / package).mkdir(exist_ok=True)
        (tmp_path / package / "__init__.py").touch()
    for name, text in modules.items():
        path = tmp_path / (name.replace("__", "/") + ".py")
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_text(text)
    return tmp_path


ROWS = "\n".join(f"    value = value * {n} + radius" for n in range(7))
BAD = {
    "modules above 400 lines": {"app__a": "x = 1\n" * 401},
    "functions above 40 lines": {"app__a": "def _f():\n" + "    x = 1\n" * 41},
    "classes above 15 methods": {"app__a": "class _A:\n" + "".join(f"    def _{n}(self): ...\n" for n in range(16))},
    "folders above 20 files": {f"app__panels__m{n}": "" for n in range(21)},
    "floors": {
        "app__a": "import engine.canvas.b",
        "engine__canvas__b": "import engine.brush.c",
        "engine__brush__c": "",
    },
    "floors within a folder": {"app__a": "import app.b", "app__b": "from app import c", "app__c": ""},
    "public without docstring": {"app__a": "class A:\n    '''It is.'''\n    def at(self) -> int: ...\n"},
    "public without all types": {"app__a": "def at(x, y: int) -> int:\n    '''It is.'''\n"},
    "Any in engine": {"engine__a": "from typing import Any\nx: Any = 1"},
    "Any in app": {"app__a": "import typing\nx: typing.Any = 1"},
    "repeated file names": {"app__a": "", "engine__a": ""},
    "functions or classes of one name in 3 modules": {f"app__{n}": f"{GOOD}" for n in "abc"},
    "constants of one name in 3 modules": {f"app__{n}": "SIDE = 3" for n in "abc"},
    "duplicated blocks": {f"app__{n}": f"def _{n}(value: int, radius: int) -> None:\n{ROWS}" for n in "ab"},
    "comparisons with a mode's name": {"app__a": "x = brush.mode in ('erase', 'smooth')"},
}


def test_there_is_a_bad_house_for_every_count():
    assert set(BAD) == set(COUNTED)


@pytest.mark.parametrize("name", BAD)
def test_what_is_worse_is_counted(tmp_path, name):
    best = counted(house(tmp_path, app__good=GOOD, engine__well="x = 1"))
    assert worse(best, best) == []
    found = counted(house(tmp_path, **BAD[name]))
    assert found[name] - best[name] == (2 if name.startswith("floors") else 1)
    assert f"{name}: found {found[name]}, expected at most {best[name]}; " in "\n".join(worse(found, best))


def test_the_table_has_a_row_for_each_count(now, stored):
    told = table(stored, now)
    assert all(f"| {name} | {stored['before'][name]} |" in told for name in COUNTED)
