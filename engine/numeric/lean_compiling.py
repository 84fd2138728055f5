"""Leaves out what numba does beside compiling, or does again, a third of its time: nothing of it changes what a kernel
computes.

Each is a detail of numba's own; a version of it that has none of that name goes on as it always does.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from typing import cast

from llvmlite.binding import ffi
from numba.core import event, ir, postproc
from numba.core.compiler import Flags
from numba.core.targetconfig import ConfigStack
from numba.core.types import BaseFunction, Type
from numba.core.typing import templates
from numba.np import arrayobj

_OF_THE_CALLER = ("release_gil", "no_cpython_wrapper", "no_cfunc_wrapper")  # no function that it calls hears of these
_MISSING = object()


def leave_out() -> None:
    """Takes it all away, for this process."""
    for each in (
        _c_callers,
        _told_sizes,
        _flags_told,
        _own_functions_again,
        _resolved_again,
        _variables_of_blocks,
        _parts_one_by_one,
        _events,
    ):
        with suppress(AttributeError, KeyError, ValueError):
            each()


def _c_callers() -> None:
    """Makes nothing by which C would call a kernel, unless it is asked for."""
    Flags.options["no_cfunc_wrapper"]._default = True


def _told_sizes() -> None:
    """Has slices of another size refused by one text: to write both sizes, each kernel that copies a slice would carry
    what makes and joins strings."""
    for template in templates.builtin_registry.functions:
        if getattr(template, "_overload_func", None) is arrayobj.ol_raise_with_shape_context_cpu:
            template._overload_func = staticmethod(arrayobj.ol_raise_with_shape_context_generic)


def _flags_told() -> None:
    """Compares what kernels are compiled with by what is set: each look into a table would go through all options."""

    def equal(one: Flags, other: Flags) -> bool:
        if type(one) is not type(other):
            return False
        return one is other or one._values == other._values or one.values() == other.values()

    def hashed(one: Flags) -> int:
        return hash(type(one))

    def values(self: Flags) -> dict[str, object]:
        return {**defaults, **self._values}

    defaults = {name: option.default for name, option in Flags.options.items()}
    Flags.__eq__, Flags.__hash__, Flags.values = equal, hashed, values


def _own_functions_again() -> None:
    """Has numba's own functions, such as `min`, compiled once for all sorts of kernels, not for each."""
    template = templates._OverloadFunctionTemplate
    before = template._get_impl

    def found(self: templates._OverloadFunctionTemplate, args: tuple[object, ...], kws: dict[str, object]) -> object:
        flags = ConfigStack.top_or_none()
        if flags is None:
            return before(self, args, kws)
        told = flags.copy()
        for name in _OF_THE_CALLER:
            told.discard(name)
        key = self.context, tuple(args), tuple(kws.items()), told
        have = self._impl_cache.get(key, _MISSING)
        return self._build_impl(key, args, kws) if have is _MISSING else have

    template._get_impl = found


def _resolved_again() -> None:
    """Finds what a built-in function gives for some types once: for each `+` of each kernel numba would try all that
    it knows of `+`."""
    looked_up = BaseFunction.get_call_type
    known: dict[tuple[object, ...], tuple[BaseFunction, templates.Signature, object]] = {}

    def found(
        self: BaseFunction, context: object, args: tuple[Type, ...], kws: dict[str, Type]
    ) -> templates.Signature | None:
        if kws:
            return looked_up(self, context, args, kws)
        flags = ConfigStack.top_or_none()
        told = "" if flags is None else repr([i for i in flags._values.items() if i[0] not in _OF_THE_CALLER])
        key = id(self), id(context), told, *args
        if key not in known:
            signature = looked_up(self, context, args, kws)
            known[key] = self, signature, self.get_impl_key(signature)  # the function is kept, and so its id
            return signature
        _, signature, implementation = known[key]
        vars(self)["_impl_keys"][signature.args] = implementation
        return signature

    BaseFunction.get_call_type = found  # type: ignore[method-assign, assignment]


def _variables_of_blocks() -> None:
    """Asks only for generators which variables live as a block begins: numba would find it out after each pass."""
    whole = postproc.PostProcessor.run
    transforms, lifetime = postproc.transforms, postproc.VariableLifetime

    def run(self: postproc.PostProcessor, emit_dels: bool = False, extend_lifetimes: bool = False) -> None:
        function = self.func_ir
        if function.is_generator:
            whole(self, emit_dels, extend_lifetimes)
            return
        function.blocks = transforms.canonicalize_cfg(function.blocks)
        function.variable_lifetime, function.generator_info = lifetime(function.blocks), None
        if emit_dels:
            self._insert_var_dels(extend_lifetimes=extend_lifetimes)

    postproc.PostProcessor.run = run


def _parts_one_by_one() -> None:
    """Lists the variables of an instruction by the types of its parts: numba asks each of five questions in a call of
    its own."""
    sorts: dict[type, int] = {}
    nothing, variable, instruction, several, named = range(5)

    def sort_of(kind: type) -> int:
        bases = (ir.Var, variable), (ir.Inst, instruction), ((list, tuple), several), (dict, named)
        sort = next((sort for base, sort in bases if issubclass(kind, base)), nothing)
        return sorts.setdefault(kind, sort)

    def gather(parts: Iterable[object], out: list[ir.Var]) -> None:
        for part in parts:
            kind = type(part)
            sort = sorts[kind] if kind in sorts else sort_of(kind)
            if sort == variable:
                out.append(part)
            elif sort == instruction:
                out += cast(ir.Inst, part).list_vars()
            elif sort:
                gather(cast(list[object], part) if sort == several else cast(dict[str, object], part).values(), out)

    def listed(self: ir.Inst, told: object) -> list[ir.Var]:
        out: list[ir.Var] = []
        gather((told,), out)
        return out

    ir.Inst._rec_list_vars = listed


def _events() -> None:
    """Tells of nothing that nobody listens to: every call of LLVM, which kernels have by the hundred, is an event."""
    begun, ended = event.start_event, event.end_event

    def begin(kind: str, *told: object, **more: object) -> None:
        if event._registered[kind]:
            begun(kind, *told, **more)

    def end(kind: str, *told: object, **more: object) -> None:
        if event._registered[kind]:
            ended(kind, *told, **more)

    event.start_event, event.end_event = begin, end
    lock = ffi.lib._lock
    lock._cblist[:] = [pair for pair in lock._cblist if pair[0].__module__ != "numba.core.base"]
