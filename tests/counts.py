"""Counts of the house: how large its modules, functions, classes and folders are, what has no docstring or no types,
which names come more than once.

    python tests/counts.py                    the table: before, allowed, now
    python tests/counts.py --list COUNT       what a count counts
    python tests/counts.py --store            allows what is there now, where that is better
    python tests/counts.py --before FOLDER    takes the first column from the sources in FOLDER

Of every count less is better, but for those that only tell how much there is.
"""

from __future__ import annotations

import argparse
import ast
import json
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from functools import cached_property
from pathlib import Path

from sources import PACKAGES, ROOT, Module, imported, modules, program, unit

STORED = Path(__file__).with_suffix(".json")
LINES, BODY, METHODS, FILES = 400, 40, 15, 20  # most of a module, a function, a class, a folder
BLOCK = 6  # equal lines in a row that are a duplicated block
COMMON = 3  # modules that have a public name, from which it is counted
FREE = ("engine/numeric", "engine/brush", "engine/texture")  # folders that may hold more files
MODES = {"paint", "erase", "smooth", "raster", "example", "grown"}  # names of stroke modes
# Classes above METHODS whose methods a library asks for: the class, and why.
FORCED: dict[str, str] = {}

Function = ast.FunctionDef | ast.AsyncFunctionDef


class House:
    """The program's sources below a folder, and what there is to count in them, each as a list of lines that say
    where."""

    def __init__(self, root: Path = ROOT) -> None:
        self.root, self.modules = root, program() if root == ROOT else modules(root)

    # --- what there is -----------------------------------------------------------------------------------------------

    def all_modules(self) -> list[str]:
        return sorted(self.modules)

    def all_functions(self) -> list[str]:
        return [f"{module.name}.{name}" for module, name, _ in self._functions]

    def all_classes(self) -> list[str]:
        return [f"{module.name}.{node.name}" for module, node in self._classes]

    def all_public(self) -> list[str]:
        return [where for where, _ in self._public]

    # --- size --------------------------------------------------------------------------------------------------------

    def long_modules(self) -> list[str]:
        lines = {name: len(module.text.splitlines()) for name, module in self.modules.items()}
        return [f"{name}: {count}" for name, count in lines.items() if count > LINES]

    def long_functions(self) -> list[str]:
        return [f"{module.name}.{name}: {n}" for module, name, node in self._functions if (n := _span(node)) > BODY]

    def wide_classes(self) -> list[str]:
        wide = [(f"{module.name}.{node.name}", _methods(node)) for module, node in self._classes]
        return [f"{name}: {count}" for name, count in wide if count > METHODS and name not in FORCED]

    def full_folders(self) -> list[str]:
        held = Counter(str(m.path.parent.relative_to(self.root)) for m in self.modules.values() if not m.package)
        return [f"{folder}: {count}" for folder, count in sorted(held.items()) if count > FILES and folder not in FREE]

    def floors(self) -> list[str]:
        """The units on the longest path of imports."""
        return _longest({unit(name) for name in self.modules} - {*PACKAGES}, self._imports(unit))

    def floors_within_a_folder(self) -> list[str]:
        """The modules of one folder on the longest path of imports."""
        graph, rooms = self._imports(lambda name: name), defaultdict(set)
        for name, module in self.modules.items():
            rooms[module.path.parent].add(name)
        return max((_longest(names, graph) for names in rooms.values()), key=len)

    # --- words -------------------------------------------------------------------------------------------------------

    def without_docstring(self) -> list[str]:
        return [where for where, node in self._public if ast.get_docstring(node) is None]

    def without_types(self) -> list[str]:
        return [where for where, node in self._public if not isinstance(node, ast.ClassDef) and not _typed(node)]

    def any_in_engine(self) -> list[str]:
        return self._any("engine")

    def any_in_app(self) -> list[str]:
        return self._any("app")

    def repeated_file_names(self) -> list[str]:
        held: dict[str, list[str]] = defaultdict(list)
        for module in self.modules.values():
            if not module.path.name.startswith("__"):
                held[module.path.name].append(module.name)
        return [f"{name}: {', '.join(where)}" for name, where in sorted(held.items()) if len(where) > 1]

    def common_names(self) -> list[str]:
        """Functions and classes of one public name in several modules."""
        return self._common(lambda node: isinstance(node, Function | ast.ClassDef))

    def common_constants(self) -> list[str]:
        return self._common(lambda node: isinstance(node, ast.Assign | ast.AnnAssign))

    # --- repetition --------------------------------------------------------------------------------------------------

    def duplicated_blocks(self) -> list[str]:
        """Each run of equal lines of code, at every place but its first."""
        seen: dict[tuple[str, ...], tuple[str, int]] = {}
        out = []
        for name, module in self.modules.items():
            lines, until = _code(module), 0
            for i in range(len(lines) - BLOCK + 1):
                block = tuple(text for _, text in lines[i : i + BLOCK])
                first = seen.setdefault(block, (name, lines[i][0]))
                if first != (name, lines[i][0]) and i >= until:
                    out.append(f"{name}:{lines[i][0]} as {first[0]}:{first[1]}")
                if first != (name, lines[i][0]):
                    until = i + 2  # the next line goes on with it
        return out

    def compared_modes(self) -> list[str]:
        out = []
        for module in self.modules.values():
            for node in module.nodes:
                if isinstance(node, ast.Compare) and _compares_mode(node):
                    out.append(f"{module.name}:{node.lineno}: {ast.unparse(node)}")
        return out

    # --- the parts of all modules ------------------------------------------------------------------------------------

    def _imports(self, of: Callable[[str], str]) -> dict[str, set[str]]:
        """What imports what, by what `of` makes of the modules' names."""
        graph: dict[str, set[str]] = defaultdict(set)
        for name, module in self.modules.items():
            graph[of(name)] |= {of(other) for other in imported(module, self.modules) if other in self.modules}
        return graph

    @cached_property
    def _functions(self) -> list[tuple[Module, str, Function]]:
        """Every function and method, those within functions too."""
        return [
            (module, node.name, node)
            for module in self.modules.values()
            for node in module.nodes
            if isinstance(node, Function)
        ]

    @cached_property
    def _classes(self) -> list[tuple[Module, ast.ClassDef]]:
        return [
            (module, node)
            for module in self.modules.values()
            for node in module.nodes
            if isinstance(node, ast.ClassDef)
        ]

    @cached_property
    def _public(self) -> list[tuple[str, Function | ast.ClassDef]]:
        """Public functions and classes of public modules, and the public methods of such classes."""
        out: list[tuple[str, Function | ast.ClassDef]] = []
        for module in self.modules.values():
            if any(part.startswith("_") for part in module.name.split(".")):
                continue
            for node in _defined(module.tree.body):
                where = f"{module.name}.{node.name}"
                out.append((where, node))
                if isinstance(node, ast.ClassDef):
                    out += [(f"{where}.{method.name}", method) for method in _defined(node.body)]
        return out

    def _common(self, good: Callable[[ast.stmt], bool]) -> list[str]:
        held: dict[str, set[str]] = defaultdict(set)
        for module in self.modules.values():
            for name in (name for node in module.tree.body if good(node) for name in _names(node)):
                held[name].add(module.name)
        rows = sorted(held.items(), key=lambda row: (-len(row[1]), row[0]))
        return [f"{name}: {len(w)}" for name, w in rows if len(w) >= COMMON and not name.startswith("_")]

    def _any(self, package: str) -> list[str]:
        return [
            f"{module.name}:{node.lineno}"
            for module in self.modules.values()
            if module.name.split(".")[0] == package
            for node in module.nodes
            if (isinstance(node, ast.Name) and node.id == "Any")
            or (isinstance(node, ast.Attribute) and node.attr == "Any")
        ]


def _longest(names: set[str], graph: dict[str, set[str]]) -> list[str]:
    """The longest path that stays among these names, from the top down; there must be no ring among them."""
    known: dict[str, list[str]] = {}

    def path(name: str) -> list[str]:
        if name not in known:
            under = sorted((graph[name] & names) - {name})
            known[name] = [name, *max((path(other) for other in under), key=len, default=[])]
        return known[name]

    return max((path(name) for name in sorted(names)), key=len, default=[])


def _defined(body: list[ast.stmt]) -> Iterator[Function | ast.ClassDef]:
    for node in body:
        if isinstance(node, Function | ast.ClassDef) and not node.name.startswith("_"):
            yield node


def _span(node: Function) -> int:
    """Lines of a function's body: a long list of parameters makes none of it."""
    return (node.end_lineno or node.lineno) - node.body[0].lineno + 1


def _methods(node: ast.ClassDef) -> int:
    return sum(isinstance(part, Function) for part in node.body)


def _typed(node: Function) -> bool:
    """Whether all parameters but the own object, and what comes back, have types."""
    given = node.args
    named = [*given.posonlyargs, *given.args, *given.kwonlyargs, *filter(None, (given.vararg, given.kwarg))]
    if named and named[0].arg in ("self", "cls"):
        named = named[1:]
    return node.returns is not None and all(one.annotation is not None for one in named)


def _names(node: ast.stmt) -> Iterator[str]:
    """What a statement at the top of a module defines."""
    if isinstance(node, Function | ast.ClassDef):
        yield node.name
    elif isinstance(node, ast.Assign):
        for target in node.targets:
            yield from (part.id for part in ast.walk(target) if isinstance(part, ast.Name))
    elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
        yield node.target.id


def _code(module: Module) -> list[tuple[int, str]]:
    """(number, text) of its lines, without what is blank, a comment, a docstring or an import."""
    skipped: set[int] = set()
    for node in module.nodes:
        words = (
            isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
        )
        if words or isinstance(node, ast.Import | ast.ImportFrom):
            skipped.update(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    rows = enumerate((line.strip() for line in module.text.splitlines()), 1)
    return [(n, line) for n, line in rows if line and not line.startswith("#") and n not in skipped]


def _compares_mode(node: ast.Compare) -> bool:
    """Whether something called mode is compared with the name of a stroke mode."""
    sides = [node.left, *node.comparators]
    called = any(getattr(side, "attr", getattr(side, "id", "")) == "mode" for side in sides)
    texts = {part.value for side in sides for part in ast.walk(side) if isinstance(part, ast.Constant)}
    return called and bool(texts & MODES)


Row = Callable[[House], list[str]]
# How much there is, which may grow.
TOLD: dict[str, Row] = {
    "modules": House.all_modules,
    "functions and methods": House.all_functions,
    "classes": House.all_classes,
    "public functions, classes and methods": House.all_public,
}
# What may not grow.
COUNTED: dict[str, Row] = {
    f"modules above {LINES} lines": House.long_modules,
    f"functions above {BODY} lines": House.long_functions,
    f"classes above {METHODS} methods": House.wide_classes,
    f"folders above {FILES} files": House.full_folders,
    "floors": House.floors,
    "floors within a folder": House.floors_within_a_folder,
    "public without docstring": House.without_docstring,
    "public without all types": House.without_types,
    "Any in engine": House.any_in_engine,
    "Any in app": House.any_in_app,
    "repeated file names": House.repeated_file_names,
    f"functions or classes of one name in {COMMON} modules": House.common_names,
    f"constants of one name in {COMMON} modules": House.common_constants,
    "duplicated blocks": House.duplicated_blocks,
    "comparisons with a mode's name": House.compared_modes,
}


def counted(root: Path = ROOT) -> dict[str, int]:
    """Every count of the sources below a folder."""
    return counts_of(House(root))


def counts_of(house: House) -> dict[str, int]:
    return {name: len(row(house)) for name, row in {**TOLD, **COUNTED}.items()}


def worse(now: dict[str, int], allowed: dict[str, int]) -> list[str]:
    """One line for each count that is above what is allowed."""
    return [
        f"{name}: found {now[name]}, expected at most {allowed[name]}; tests/counts.py --list '{name}' tells which"
        for name in COUNTED
        if now[name] > allowed[name]
    ]


def table(stored: dict[str, dict[str, int]], now: dict[str, int]) -> str:
    lines = ["| count | before | allowed | now |", "| --- | ---: | ---: | ---: |"]
    for name, count in now.items():
        row = [str(stored[column].get(name, "")) for column in ("before", "allowed")]
        lines.append(f"| {name} | {row[0]} | {row[1]} | {count} |")
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], allow_abbrev=False)
    parser.add_argument("--list", metavar="COUNT", choices=[*TOLD, *COUNTED], help="tell what a count counts")
    parser.add_argument("--store", action="store_true", help="allow what is there now, where that is better")
    parser.add_argument("--before", metavar="FOLDER", type=Path, help="sources that the first column is of")
    options = parser.parse_args()
    if options.list is not None:
        print("\n".join({**TOLD, **COUNTED}[options.list](House())))
        return 0
    stored = json.loads(STORED.read_text()) if STORED.exists() else {"before": {}, "allowed": {}}
    now = counted()
    if options.before is not None:
        stored["before"] = counted(options.before)
    if options.store:
        stored["allowed"] = {name: min(now[name], stored["allowed"].get(name, now[name])) for name in COUNTED}
    if options.store or options.before is not None:
        STORED.write_text(json.dumps(stored, indent=1) + "\n")
    print(table(stored, now))
    for line in worse(now, {**now, **stored["allowed"]}):
        print(line, file=sys.stderr)
    return bool(worse(now, {**now, **stored["allowed"]}))


if __name__ == "__main__":
    sys.exit(main())
