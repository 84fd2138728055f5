"""The texts that the window shows, found in the source, and which of them a catalogue lacks.

python tests/texts.py               all of them, with where they stand
python tests/texts.py --missing de  those that a language has not, as rows of its catalogue
python tests/texts.py --compile     writes the .mo beside each .po of palettes/languages
"""

import ast
import re
import struct
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CATALOGUES = ROOT / "palettes" / "languages"
COMPLETE = ("de", "fr")
# What of the source draws, or is drawn; the rest speaks to the terminal, or to programs.
SHOWN = (
    *("app/actions", "app/desk", "app/panels", "app/tools", "app/input", "app/land"),
    *(
        "app/cursor.py",
        "app/guide_marks.py",
        "app/window.py",
        "app/router.py",
        "app/faults/log.py",
        "app/theme/looks.py",
    ),
    *("engine/brush/ops.py", "engine/brush/modes.py", "engine/brush/targets.py", "engine/brush/inputs.py"),
    *(
        "engine/brush/settings.py",
        "engine/brush/steadying.py",
        "engine/numeric/shapes.py",
        "engine/texture/table.py",
        "engine/numeric/blend.py",
    ),
    *("engine/studio", "engine/solids/materials.py", "engine/solids/material_sliders.py", "engine/makers/doctor"),
)
_RAISES = {"Refusal", "FieldError", "FileError", "LayerError", "ValueError", "RuntimeError", "KeyError", "TypeError"}
_CALLS = {
    "TypeVar",
    "NamedTuple",
    "getattr",
    "setattr",
    "get",
    "pop",
    "open_popup",
    "begin_popup",
    "begin_child",
    "strftime",
    "compile",
    "get_id",
    "startswith",
    "endswith",
    "removeprefix",
    "removesuffix",
    "split",
    "shader_source",
    "set_next_item_allow_overlap",
    "placed",
    "named",
    "trace",
    "print",
    "CDLL",
    "environ",
    "begin",
    "spare",
    "fault",
    "spare_drawing",
    "Thread",
    "error",
    "info",
    "warning",
    "text",
    "flag",
    "integer",
    "integers",
    "partition",
}
_WORD = re.compile(r"[A-Z][a-zé]+(?:[ …-].*)?|.*[a-z].* .*", re.DOTALL)
_NONE = re.compile(r"[\w.-]+\.\w+|#\w*|%.*|[-\w]+/[-\w/*.]+|(?:Ctrl|Alt|Shift)\+.*|\(.*\\.*", re.DOTALL)


def texts(root=ROOT):
    """The texts by what they say, with places such as {name}, and where each stands first."""
    found = {}
    for shown in SHOWN:
        path = root / shown
        for file in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
            for text, line in texts_of(file.read_text()):
                found.setdefault(text, f"{file.relative_to(root)}:{line}")
    return found


def texts_of(source):
    """(text, line) of a module."""
    tree = ast.parse(source)
    skipped = _skipped(tree)
    for node in ast.walk(tree):
        if id(node) in skipped:
            continue
        if isinstance(node, ast.JoinedStr):
            text = _form(node)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            text = node.value
        else:
            continue
        text = re.sub(r"^[\s\ue000-\uf8ff]*(?:\{\w*icon\w*\}\s*)*|\s+$", "", text.partition("##")[0])
        text = text.replace("{}", "{why}" if "{name}" in text else "{name}")
        for part in text.split("\n"):
            if is_text(part):
                yield part, node.lineno


def is_text(text):
    """Whether somebody is to read it: words, not names of files, keys and colours."""
    bare = re.sub(r"\{\w+\}", "", text)
    return bool(_WORD.fullmatch(text.strip()) and re.search(r"[A-Za-z]{2}", bare) and not _NONE.fullmatch(text))


def _skipped(tree):
    """Nodes whose texts nobody sees: docstrings, what is raised, compared, looked up, or annotated."""
    out = set()

    def skip(node):
        out.update(id(each) for each in ast.walk(node))

    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(node, ast.Module | ast.FunctionDef | ast.ClassDef) and body and ast.get_docstring(node, False):
            skip(body[0])
        if isinstance(node, ast.JoinedStr):
            for value in node.values:
                if isinstance(value, ast.Constant):
                    skip(value)
                elif isinstance(value, ast.FormattedValue) and value.format_spec is not None:
                    skip(value.format_spec)
        elif isinstance(node, ast.Assert) or (isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call)):
            skip(node)
        elif isinstance(node, ast.Compare):
            for each in (node.left, *node.comparators):
                if isinstance(each, ast.Constant):
                    skip(each)
        elif isinstance(node, ast.Subscript):
            skip(node.slice)
        elif isinstance(node, ast.Dict):
            for key in node.keys:
                if key is not None:
                    skip(key)
        elif isinstance(node, ast.arg | ast.AnnAssign) and node.annotation is not None:
            skip(node.annotation)
        elif isinstance(node, ast.Call):
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            if name in _CALLS | _RAISES:
                for each in node.args:
                    if isinstance(each, ast.Constant | ast.JoinedStr):
                        skip(each)
    return out


def _form(node):
    """A text with places, named after what stands there."""
    out, taken = "", set()
    for value in node.values:
        if isinstance(value, ast.Constant):
            out += value.value
            continue
        name = stem = _name(value.value)
        number = 2
        while name in taken:
            name, number = f"{stem}{number}", number + 1
        taken.add(name)
        out += f"{{{name}}}"
    return out


def _name(node):
    if isinstance(node, ast.Name):
        return node.id.strip("_").lower() or "it"
    if isinstance(node, ast.Attribute):
        return "icon" if getattr(node.value, "id", "") == "icons" else node.attr
    if isinstance(node, ast.Call):
        return _name(node.func)
    for each in ast.iter_child_nodes(node):
        if isinstance(each, ast.Name | ast.Attribute | ast.Call | ast.BinOp | ast.Subscript):
            return _name(each)
    return "it"


# ---- catalogues ----


def read_po(path):
    """What texts become, by a .po file of single and continued strings."""
    rows, told, into = {}, ["", ""], None
    for line in [*path.read_text("utf-8").splitlines(), 'msgid ""']:
        line = line.strip()
        if line.startswith("msgid "):
            if told[0]:
                assert told[0] not in rows, f"{path}: twice {told[0]!r}"
                rows[told[0]] = told[1]
            told, into = [ast.literal_eval(line[6:]), ""], 0
        elif line.startswith("msgstr "):
            told[1], into = ast.literal_eval(line[7:]), 1
        elif line.startswith('"') and into is not None:
            told[into] += ast.literal_eval(line)
    return rows


def compiled(rows):
    """The bytes of a .mo file, as gettext's manual has it."""
    rows = {"": "Content-Type: text/plain; charset=UTF-8\n", **{k: v for k, v in rows.items() if v}}
    pairs = sorted((key.encode(), value.encode()) for key, value in rows.items())
    begin, table, data = 28 + 16 * len(pairs), [b"", b""], b""
    for i in (0, 1):
        for pair in pairs:
            table[i] += struct.pack("<2I", len(pair[i]), begin + len(data))
            data += pair[i] + b"\0"
    head = struct.pack("<7I", 0x950412DE, 0, len(pairs), 28, 28 + 8 * len(pairs), 0, begin)
    return head + table[0] + table[1] + data


def quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


def main(words):
    if words[:1] == ["--compile"]:
        for path in sorted(CATALOGUES.glob("*.po")):
            path.with_suffix(".mo").write_bytes(compiled(read_po(path)))
        return
    found = texts()
    if words[:1] == ["--missing"]:
        path = CATALOGUES / f"{words[1]}.po"
        has = read_po(path) if path.exists() else {}
        for text in sorted(text for text in found if not has.get(text)):
            print(f'msgid {quoted(text)}\nmsgstr ""\n')
        return
    for text, where in found.items():
        print(f"{where}: {text}")


if __name__ == "__main__":
    main(sys.argv[1:])
