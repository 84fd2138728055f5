"""The program's modules as text: where they lie, and what they import."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

ROOT = Path(__file__).parent.parent
PACKAGES = ("engine", "app")


@dataclass(frozen=True)
class Module:
    """`name`: dotted, as it is imported; `path`: its file."""

    name: str
    path: Path

    @cached_property
    def text(self) -> str:
        return self.path.read_text("utf-8")

    @cached_property
    def tree(self) -> ast.Module:
        return ast.parse(self.text)

    @cached_property
    def nodes(self) -> tuple[ast.AST, ...]:
        """All of its tree, which takes a while to walk."""
        return tuple(ast.walk(self.tree))

    @property
    def package(self) -> bool:
        """Whether it is the `__init__` of a folder."""
        return self.path.name == "__init__.py"


def modules(root: Path = ROOT) -> dict[str, Module]:
    """Every module of the program below a folder, by its dotted name."""
    found = {}
    for package in PACKAGES:
        for path in sorted((root / package).rglob("*.py")):
            parts = path.relative_to(root).with_suffix("").parts
            name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
            found[name] = Module(name, path)
    return found


@cache
def program() -> dict[str, Module]:
    """Its own modules: each is read and taken apart once, whoever looks at them."""
    return modules()


def unit(name: str) -> str:
    """The unit of the order that a module belongs to: its first two parts."""
    return ".".join(name.split(".")[:2])


def imported(module: Module, known: dict[str, Module]) -> set[str]:
    """Dotted names that a module imports anywhere in it: at the top, late, for types, or through import_module."""
    parts = module.name.split(".")
    package = parts if module.package else parts[:-1]
    out: set[str] = set()
    for node in module.nodes:
        if isinstance(node, ast.Import):
            out.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                base = ".".join([*package[: len(package) - node.level + 1], *([base] if base else [])])
            out.update(f"{base}.{alias.name}" if f"{base}.{alias.name}" in known else base for alias in node.names)
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in (
            "import_module",
            "__import__",
        ):
            out.update(a.value for a in node.args[:1] if isinstance(a, ast.Constant) and isinstance(a.value, str))
    return out
