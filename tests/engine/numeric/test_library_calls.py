"""Where pixels may hang on functions whose last bits differ between processors, or between versions of a library.

A module that a painting's pixels go through takes them from `functions` or `array_functions`, by the painting's
arithmetic.  What still calls a library is listed here, with the reason; a new call is a failure, and so is an entry
that nothing needs any more.
"""

import ast
from pathlib import Path

import pytest

ENGINE = Path(__file__).parents[3] / "engine"
FOLDERS = ("brush", "canvas", "makers", "numeric", "painting", "strokes", "texture")
FUNCTIONS = {
    *("exp", "exp2", "expm1", "log", "log2", "log10", "log1p", "sin", "cos", "tan", "sinh", "cosh", "tanh", "asinh"),
    *("arcsin", "arccos", "arctan", "arctan2", "asin", "acos", "atan", "atan2", "hypot", "power", "pow", "float_power"),
    *(
        "angle",
        "sinc",
        "cbrt",
        "dot",
        "vdot",
        "inner",
        "matmul",
        "tensordot",
        "einsum",
        "convolve",
        "polyfit",
        "linalg",
    ),
    *("fft2", "ifft2", "rfft2", "irfft2", "fft", "ifft", "rfft", "irfft"),
}
GIVEN = "given the name by the arithmetic of version 1, or of our own"
EXACT = "sums in order, without BLAS: `einsum` over one axis, or of whole numbers"
SHOWN = "shown, and part of no painting's pixels"
SOLIDS = "solids, which no recording makes"
HAND = "what the hand does, before it is recorded"
LABELS = "which pixels hang together: whole numbers alone"
REFUSED = "which placements are refused, and no pixel"
REFERENCE = "the paper's own method, which `inkfall example` has for reference, and no painting"
ADVICE = "advice, and a picture that is set straight, which is a file from then on"
FOUND = "found once, in the window or by a command: masks and colours are files from then on"
MATTES = ("belonging", "closed_form", "conjugate", "fine_rim", "marks", "patchwork", "things", "tracing")
ALLOWED = {
    "makers.doctor.flattening": ADVICE,
    "makers.doctor.measuring": ADVICE,
    **{f"texture.mattes.{name}": FOUND for name in MATTES},
    "numeric.array_functions": GIVEN,
    "numeric.functions": GIVEN,
    "numeric.formula_kernel": GIVEN,
    "numeric.impulse": GIVEN,
    "numeric.poles": GIVEN,
    "numeric.steerable": GIVEN,
    "numeric.colour_axes": GIVEN,
    "texture.continuation": GIVEN,
    "texture.example.exemplar": GIVEN,
    "brush.tints": GIVEN,
    "brush.mixture": EXACT,
    "brush.op_targets": EXACT,
    "brush.tip": EXACT,
    "texture.grey": EXACT,
    "strokes.example_region": LABELS,
    "canvas.placing.loops": REFUSED,
    "texture.example.scanline": REFERENCE,
    "brush.steadying": HAND,
    "numeric.spectra": SHOWN,
    "numeric.analysis": SHOWN,
    "numeric.prediction": SHOWN,
    "numeric.askew": SHOWN,
    "numeric.sheaf": SOLIDS,
    "numeric.directions": SOLIDS,
    "numeric.bspline": SOLIDS,
    "texture.settling": SOLIDS,
}


def calls(text):
    """What a module calls, or names, of libraries."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            if node.value.id in ("np", "math", "cmath") and node.attr in FUNCTIONS:
                yield f"{node.value.id}.{node.attr}"
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.MatMult):
            yield "@"
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("scipy"):
            yield node.module


def found():
    for folder in FOLDERS:
        for path in sorted((ENGINE / folder).rglob("*.py")):
            own = sorted(set(calls(path.read_text())) - {"np.fft"} | _transforms(path.read_text()))
            if own:
                yield ".".join(path.relative_to(ENGINE).with_suffix("").parts), own


def _transforms(text):
    """Transforms of NumPy's; shifting a spectrum is none."""
    return {f"np.fft.{name}" for name in FUNCTIONS if f"np.fft.{name}(" in text or f"np.fft.{name}," in text}


def test_no_pixel_hangs_on_a_library_unseen():
    made = dict(found())
    assert {name: own for name, own in made.items() if name not in ALLOWED} == {}
    assert [name for name in ALLOWED if name not in made] == []


@pytest.mark.parametrize("text", ["math.exp(x)", "np.linalg.eigh(x)", "a @ b", "from scipy.fft import rfft2", "np.sin"])
def test_such_a_call_is_found(text):
    assert list(calls(text))


@pytest.mark.parametrize("text", ["math.sqrt(x)", "np.fft.fftshift(x)", "own.exp(x)", "np.floor(x)"])
def test_others_are_not(text):
    assert set(calls(text)) <= {"np.fft"}
    assert not _transforms(text)
