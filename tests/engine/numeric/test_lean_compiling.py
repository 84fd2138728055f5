"""Compiling leaves out what no kernel needs; what it tells, refuses and compares stays right."""

import operator

import numpy as np
import pytest
from numba import njit, types
from numba.core import event, ir
from numba.core.compiler import Flags
from numba.core.errors import NumbaError
from numba.core.registry import cpu_target
from numba.core.typing import templates

from engine.numeric import lean_compiling
from engine.numeric.kernel import inner, kernel


@inner
def _most(values: np.ndarray) -> float:
    return max(values[0], min(values[1], values[2]))


@kernel
def _put(values: np.ndarray, out: np.ndarray) -> float:
    out[1:] = values
    return min(_most(values), max(values[0], values[1]))


def _overloads(name: str) -> list[str]:
    """What numba's own function of that name was compiled for, by the arguments' types."""
    return [
        str(key[1])
        for template in templates.builtin_registry.functions
        if getattr(getattr(template, "_overload_func", None), "__name__", "") == name
        for key in template._impl_cache
        if "float64" in str(key[1])
    ]


def test_a_kernel_is_told_of_when_somebody_listens_and_carries_nothing_that_joins_strings():
    values, out = np.array([1.0, 2.0, 3.0], np.float32), np.zeros(4, np.float32)  # no other test compiles it for these
    anew = njit(nogil=True)(_put.py_func)  # kept nowhere, so it is compiled
    with event.install_recorder("numba:compile") as recorded:
        assert anew(values, out) == 2.0
    assert "_put" in {told.data["dispatcher"].py_func.__name__ for _, told in recorded.buffer}
    assert _put(values, out) == 2.0
    assert out.tolist() == [0.0, 1.0, 2.0, 3.0]
    code = anew.inspect_llvm(anew.signatures[0])
    assert "unicode" not in code
    assert "cfunc." not in code
    with pytest.raises(ValueError, match="different size"):
        _put(values, np.zeros(6, np.float32))


def test_numbas_own_functions_are_compiled_once_for_kernels_of_both_sorts():
    names = ("ol_min", "ol_max")
    before = [_overloads(name) for name in names]  # of other sorts of functions, too, if other tests came before
    _put(np.array([1.0, 2.0, 3.0]), np.zeros(4))
    for name, known in zip(names, before, strict=True):
        new = _overloads(name)[len(known) :]
        assert len(new) == len(set(new))
        assert not set(new) & set(known)


def test_what_kernels_are_compiled_with_is_compared_by_value():
    one, other = Flags(), Flags()
    assert one.no_cfunc_wrapper
    assert one == other
    one.nrt = Flags.options["nrt"].default
    assert one == other
    assert hash(one) == hash(other)
    one.nrt = not other.nrt
    assert one != other
    assert one != 1


@pytest.mark.parametrize("kind", [types.int64, types.float32, types.boolean])
def test_what_a_built_in_function_gives_is_found_once_and_is_what_numba_finds(kind):
    context = cpu_target.typing_context
    added = context.resolve_value_type(operator.add)
    found = added.get_call_type(context, (kind, types.float64), {})
    assert added.get_call_type(context, (kind, types.float64), {}) is found
    assert found == types.float64(types.float64, types.float64)
    assert added.get_impl_key(found) is operator.add
    for wrong in (types.none, types.undefined):
        with pytest.raises(NumbaError):
            added.get_call_type(context, (kind, wrong), {})


def test_the_variables_of_an_instruction_are_listed_in_its_order():
    where = ir.Loc("nowhere", 1)
    one, two, three = (ir.Var(None, name, where) for name in ("one", "two", "three"))
    call = ir.Expr.call(one, [two, ir.Expr.getattr(three, "x", where)], (("name", one),), where)
    assert call.list_vars() == [one, two, three, one]
    assert ir.Assign(call, three, where).list_vars() == [one, two, three, one, three]
    assert ir.Assign(ir.Const(1, where), two, where).list_vars() == [two]


def test_leaving_out_twice_does_no_harm_and_what_numba_lacks_is_left_alone(monkeypatch):
    lean_compiling.leave_out()
    assert Flags() == Flags()
    monkeypatch.setattr(lean_compiling, "ffi", object())  # another version, without that lock
    monkeypatch.setattr(lean_compiling, "arrayobj", object())
    lean_compiling.leave_out()
