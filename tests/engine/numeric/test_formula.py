"""The formula language: what it says, what it refuses and where, and that nothing gets out of it."""

import ast
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.formula import (
    CONSTANTS,
    DEPTH_CAP,
    FORMULA_CAP,
    FUNCTIONS,
    NAMES,
    NODES_CAP,
    FormulaError,
    parse,
    printed,
    variables,
)
from engine.numeric.formula_kernel import kernel, source

ROWS = ("pic", "luma", "tex", "d", "pressure", "x", "y")


def inputs(n=64, seed=1):
    rng = np.random.default_rng(seed)
    rows = {name: rng.uniform(0, 1, n).astype(np.float32) for name in ROWS}
    rows["x"] = (rows["x"] * 200 - 100).astype(np.float32)
    rows["y"] = (rows["y"] * 200 - 100).astype(np.float32)
    return rows


def run(text, rows=None, colour=0.25, level=3.0):
    rows = inputs() if rows is None else rows
    out = np.full(rows["x"].shape, np.nan, np.float32)
    kernel(parse(text))(*(rows[name] for name in ROWS), colour, level, out)
    return out


# ---- a plain evaluator of the tree, in NumPy ------------------------------------------------------------------------

PLAIN = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "neg": np.negative,
    "pow": lambda a, b: np.power(np.abs(a), b),
    "mod": lambda a, b: a - b * np.floor(np.divide(a, b)),
    "<": lambda a, b: np.less(a, b) * 1.0, "<=": lambda a, b: np.less_equal(a, b) * 1.0,
    ">": lambda a, b: np.greater(a, b) * 1.0, ">=": lambda a, b: np.greater_equal(a, b) * 1.0,
    "if": lambda test, a, b: np.where(np.not_equal(test, 0), a, b),
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "atan2": np.arctan2, "abs": np.abs, "floor": np.floor,
    "sqrt": lambda a: np.sqrt(np.abs(a)), "exp": lambda a: np.exp(np.minimum(a, 700.0)),
    "log": lambda a: np.log(np.abs(a) + 1e-300), "fract": lambda a: a - np.floor(a),
    "min": np.minimum, "max": np.maximum, "clamp": lambda a, lo, hi: np.minimum(np.maximum(a, lo), hi),
    "mix": lambda a, b, part: a + (b - a) * part, "step": lambda edge, a: np.greater_equal(a, edge) * 1.0,
    "smoothstep": lambda lo, hi, a: (lambda s: s * s * (3 - 2 * s))(np.clip(np.divide(a - lo, hi - lo), 0.0, 1.0)),
}  # fmt: skip


def plain(tree, values):
    if tree[0] == "number":
        return np.float64(tree[1])
    if tree[0] == "name":
        return np.asarray(values[tree[1]], np.float64)
    return PLAIN[tree[0]](*(plain(part, values) for part in tree[1:]))


def expected(text, rows, colour=0.25, level=3.0):
    with np.errstate(all="ignore"):
        value = np.broadcast_to(plain(parse(text), {**rows, "colour": colour, "level": level}), rows["x"].shape)
        return np.where(np.isfinite(value), np.clip(value, -1e6, 1e6), 0.0)


FORMULAS = (
    "colour - pic", "1 - 2*pic", "0.5+0.5*sin(20*x+5*cos(floor(x*8)))",
    "mix(0.2,0.9,smoothstep(0.3,0.6,fract(x*7+y*3)))",
    "1 if (x*x+y*y)<2000 else exp(-(x*x+y*y)*4)", "x/0", "log(-x)+sqrt(-1)", "pow(-2,0.5)", "x%0", "x % 3 - -3**2",
    "exp(1e300)", "2**-pic**2", "tex*d*pressure + luma - level", "(pic < .5) * 2 + (pic >= 0.5)", "-(-(+pic))",
    "min(x, y) * max(tex, d)", "clamp(x/50, -1, 1)", "atan2(y, x) / pi", "step(0.5, tex) if pic > d else -1", "0/0",
    "1e-3*tau + e", "abs(tan(x))", "1 if x < 0 else 2 if y < 0 else 3", "1e300 * 1e300", "-1e300", "pic\n + \t1",
)  # fmt: skip


@pytest.mark.parametrize("text", FORMULAS)
def test_a_formula_means_what_its_tree_says(text):
    rows = inputs()
    np.testing.assert_allclose(run(text, rows), expected(text, rows), rtol=2e-6, atol=1e-6)


@pytest.mark.parametrize("text", [t for t in FORMULAS if "noise" not in t])
def test_arithmetic_reads_as_python_reads_it(text):
    """The same text through Python's own grammar gives the same tree."""
    text = text.replace("\n", " ").replace("\t", " ")
    assert parse(text) == from_python(ast.parse(text, mode="eval").body)


def from_python(node):
    operators = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "pow", ast.Mod: "mod"}
    signs = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}
    match node:
        case ast.Constant():
            return ("number", float(node.value))
        case ast.Name():
            return ("number", CONSTANTS[node.id]) if node.id in CONSTANTS else ("name", node.id)
        case ast.UnaryOp():
            inner = from_python(node.operand)
            return ("neg", inner) if isinstance(node.op, ast.USub) else inner
        case ast.BinOp():
            return (operators[type(node.op)], from_python(node.left), from_python(node.right))
        case ast.Compare():
            return (signs[type(node.ops[0])], from_python(node.left), from_python(node.comparators[0]))
        case ast.IfExp():
            return ("if", from_python(node.test), from_python(node.body), from_python(node.orelse))
    return (node.func.id, *map(from_python, node.args))


REFUSED = (
    ("", 1, "nothing"),
    ("  ", 1, "nothing"),
    ("1 +", 4, "the end"),
    ("x y", 3, '"y"'),
    ("x.__class__", 2, '"."'),
    ("foo(1)", 1, '"foo"'),
    ("__import__('os')", 12, '"\'"'),
    ("eval", 1, '"eval"'),
    ("open(x)", 1, '"open"'),
    ("sin(1,2)", 7, "one value more"),
    ("clamp(1,2)", 10, '")"'),
    ("1<2<3", 4, '"<"'),
    ("(1", 3, "the end"),
    ("1e999", 1, '"1e999"'),
    ("'a'*9", 1, '"\'"'),
    ("pic[0]", 4, '"["'),
    ("lambda: 1", 7, '":"'),
    ("sin", 4, "the end"),
    ("sin(x=1)", 6, '"="'),
    ("sin(*x)", 5, '"*"'),
    ("(y:=1)", 3, '":"'),
    ("f'{x}'", 2, '"\'"'),
    ("x//2", 3, '"/"'),
    ("1 if 2", 7, "the end"),
    ("x and y", 3, '"and"'),
    ("not x", 1, '"not"'),
    ("True", 1, '"True"'),
    ("1j", 2, '"j"'),
    ("0x10", 2, '"x10"'),
    ("1_000", 2, '"_000"'),
    ("~x", 1, '"~"'),
    ("x == y", 3, '"="'),
    ("x;y", 2, '";"'),
    ("#", 1, '"#"'),
    ("x\0", 2, r'"\x00"'),
    ("\u212f", 1, '"\\u212f"'),
    ("x\u202e", 2, '"\\u202e"'),
    ("\uff58", 1, '"\\uff58"'),
    ("{1}", 1, '"{"'),
    ("pic\xa0+ 1", 4, '"\\xa0"'),
    ("(" * 9999, None, None),
    ("(" * 200, DEPTH_CAP + 2, "one level more"),
    ("-" * 200 + "1", DEPTH_CAP + 2, "one level more"),
    ("+".join("x" * 200), NODES_CAP, "one part more"),
    ("x**" * 60 + "x", None, "one level more"),
    ("sin(" * 90 + "x" + ")" * 90, None, "one level more"),
    ("x if y else " * 60 + "1", None, "one level more"),
    ("1" * FORMULA_CAP + "1", FORMULA_CAP + 1, "4097 characters"),
    ("9" * 400, 1, None),
    ("yield x", 1, '"yield"'),
    ("@x", 1, '"@"'),
    ("\\", 1, None),
    ("x!", 2, '"!"'),
    ("...", 1, '"."'),
)


@pytest.mark.parametrize(("text", "column", "found"), REFUSED, ids=range(len(REFUSED)))
def test_anything_else_is_refused_with_its_column(text, column, found):
    with pytest.raises(FormulaError) as caught:
        parse(text)
    message = str(caught.value)
    assert "\n" not in message
    assert message.isascii()
    assert len(message) < 320
    assert column is None or caught.value.column == column
    assert found is None or caught.value.found == found
    assert message == f"formula, column {caught.value.column}: found {caught.value.found}, expected " + (
        caught.value.expected
    )


@pytest.mark.parametrize("value", [None, 3, b"1", ["1"]])
def test_what_is_no_text_is_refused(value):
    with pytest.raises(FormulaError):
        parse(value)


def test_variables_are_the_names_it_looks_at():
    assert variables(parse("pic + sin(x) * 2 if d < 1 else pi")) == {"pic", "x", "d"}
    assert variables(parse("1")) == frozenset()


def test_noise_is_bound_to_its_place():
    rows = inputs(4096)
    rows["x"] = np.repeat(np.arange(-32, 32, dtype=np.float32), 64)
    rows["y"] = np.tile(np.arange(64, dtype=np.float32), 64)
    whole = run("noise(x, y)", rows)
    assert (run("noise(x + 0.7, y + 0.2)", rows) == whole).all()
    assert len(np.unique(whole)) > 4090
    assert abs(whole.mean() - 0.5) < 0.02
    assert abs(whole.std() - 12**-0.5) < 0.02
    assert (run("noise(x * 1e30, 0/0)", rows) == 0).all()


def test_the_same_tree_is_compiled_once():
    assert kernel(parse("pic+1")) is kernel(parse(" pic  + 1.0 "))


# ---- attempts to get out ----

WORDS = r"""if else
+ - * / % ** ( ) , < >= 1 .5 2e3 . : [ ] { } ' " = := ; @ # \ f' ... 5_0 0b1 1j _ __class__ __import__
lambda import eval exec os np range bounded out kernel _sin value i for in x_row while not and is None globals getattr
__builtins__"""
TOKENS = (*WORDS.split(), *NAMES, *CONSTANTS, *FUNCTIONS, " ", "\n", "\0", "\u212f")
ALLOWED = {"def", "kernel", "for", "in", "range", "out", "size", "i", "value", "np", "float64", "bounded", "if", "else"}
ALLOWED |= set(NAMES) | {f"{name}_row" for name in NAMES} | {f"_{name}" for name in FUNCTIONS}


def holds_only_what_is_allowed(tree):
    text = source(tree)
    body = printed(tree)
    numbers = r"(?<![\w.])(?:\d+\.\d+|\d+(?:\.\d+)?e[+-]?\d+|\d+)(?![\w.])"
    words = set(re.findall(r"[A-Za-z_]\w*", re.sub(numbers, " ", text)))
    assert words <= ALLOWED, words - ALLOWED
    assert re.fullmatch(r"[\w\s().,+*/<>=!\-]*", body)
    for node in ast.walk(ast.parse(body, mode="eval")):
        assert isinstance(
            node,
            ast.Expression | ast.BinOp | ast.UnaryOp | ast.Compare | ast.IfExp | ast.Call | ast.Name | ast.Constant
            | ast.operator | ast.unaryop | ast.cmpop | ast.expr_context,
        )  # fmt: skip
        if isinstance(node, ast.Name):
            assert node.id in NAMES or node.id[1:] in FUNCTIONS
        if isinstance(node, ast.Constant):
            assert type(node.value) is float
            assert np.isfinite(node.value)
        if isinstance(node, ast.Call):
            assert isinstance(node.func, ast.Name)
            assert node.func.id[1:] in FUNCTIONS
    compile(text, "<test>", "exec")


def read(text):
    try:
        return parse(text), None
    except FormulaError as error:
        return None, error


def tried(text):
    tree, error = read(text)
    if error is None:
        holds_only_what_is_allowed(tree)
        return tree
    assert 1 <= error.column <= max(len(text), FORMULA_CAP) + 1
    assert "\n" not in str(error)
    assert str(error).isascii()
    return None


@settings(deadline=None, max_examples=250)
@given(st.lists(st.sampled_from(TOKENS), max_size=40).map("".join))
def test_random_tokens_never_get_out(text):
    tried(text)


@settings(deadline=None, max_examples=300)
@given(st.text(max_size=80))
def test_random_text_never_gets_out(text):
    tried(text)


@settings(deadline=None, max_examples=200)
@given(
    st.sampled_from(FORMULAS),
    st.lists(st.tuples(st.integers(0, 80), st.sampled_from(TOKENS), st.integers(0, 3)), max_size=4),
)
def test_changed_formulas_never_get_out(text, changes):
    for at, token, length in changes:
        text = text[:at] + token + text[at + length :]
    tried(text)


NUMBERS = st.sampled_from(("0", "1", "2.5", "1e300", "1e-300", ".1", "pi")) | st.sampled_from(tuple(NAMES))
GROWN = st.recursive(
    NUMBERS,
    lambda part: st.one_of(
        st.tuples(part, st.sampled_from(("+", "-", "*", "/", "%", "**", "<")), part).map(lambda p: f"({' '.join(p)})"),
        part.map(lambda p: f"-{p}"),
        st.tuples(part, part, part).map(lambda p: f"({p[0]} if {p[1]} else {p[2]})"),
        st.sampled_from(tuple(FUNCTIONS)).flatmap(
            lambda name: st.tuples(*[part] * FUNCTIONS[name]).map(lambda p: f"{name}({', '.join(p)})")
        ),
    ),
    max_leaves=12,
)


@settings(deadline=None, max_examples=10)
@given(GROWN)
def test_every_formula_has_a_value_everywhere(text):
    tree = tried(text)
    assert tree is not None
    rows = inputs(16)
    rows["x"][:4] = (0.0, 1e30, -1e30, 3e38)
    first = run(text, rows)
    assert np.isfinite(first).all()
    assert (np.abs(first) <= 1e6).all()
    assert first.tobytes() == run(text, rows).tobytes()


def test_the_largest_formula_compiles():
    text = "sin(x*" + "*".join(["(pic+1)"] * 39) + ")"
    assert tried(text) is not None
    deepest = "-" * 39 + "x"
    assert (run(deepest) == -inputs()["x"]).all()
    long = "x" + "+1" * (NODES_CAP // 2 - 1)
    np.testing.assert_allclose(run(long), inputs()["x"] + NODES_CAP // 2 - 1, rtol=1e-5)


def test_a_long_mistake_is_shown_in_part():
    with pytest.raises(FormulaError) as caught:
        parse("9" * 400)
    assert caught.value.found == '"' + "9" * 24 + '..."'
