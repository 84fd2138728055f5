"""Leaves out what numba does beside compiling, a sixth of its time: nothing of it changes what a kernel computes.

Each is a detail of numba's own; a version of it that has none of that name goes on as it always does.
"""

from __future__ import annotations

from contextlib import suppress

from llvmlite.binding import ffi
from numba.core import event
from numba.core.compiler import Flags
from numba.core.targetconfig import ConfigStack
from numba.core.typing import templates
from numba.np import arrayobj

_OF_THE_CALLER = ("release_gil", "no_cpython_wrapper", "no_cfunc_wrapper")  # no function that it calls hears of these
_MISSING = object()


def leave_out() -> None:
    """Takes it all away, for this process."""
    for each in (_c_callers, _told_sizes, _flags_told, _own_functions_again, _events):
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

    Flags.__eq__, Flags.__hash__ = equal, hashed


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
