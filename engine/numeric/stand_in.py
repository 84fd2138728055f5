"""Kernels that nobody waits for: until one is compiled, a plain form does its work, with the same bits.

Where a thread may not compile (`kernel_cache.refusing`), a kernel that is not in the cache raises NotCompiled.  One
that is declared `or_plain` or `or_interpreted` does not: it falls back on NumPy, or on its own text, interpreted.
Only for kernels that Python calls; what other kernels call must be numba's own.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from types import FunctionType
from typing import Any, TypeVar

from numba.core.dispatcher import Dispatcher

from engine.kernel_cache import NotCompiled

REST = 0.05  # seconds after which a kernel that was missing is looked for again: that takes as long as a small tile

Function = Callable[..., Any]
F = TypeVar("F", bound=Function)


class Kernel:
    """A compiled function and the plain one that stands in for it.  `compiled`: numba's; `plain`: gives the same."""

    def __init__(self, compiled: Any, plain: Function) -> None:
        self.compiled, self.plain = compiled, plain
        self._again = 0.0  # when to look for it again; 0: it is there, or has never been asked for

    def __call__(self, *arguments: Any) -> Any:
        """Returns what the compiled function returns, or the plain one where this thread would have to wait for it."""
        if self._again and time.monotonic() < self._again:
            return self.plain(*arguments)
        try:
            result = self.compiled(*arguments)
        except NotCompiled:
            self._again = time.monotonic() + REST
            return self.plain(*arguments)
        self._again = 0.0
        return result


def or_plain(plain: Function) -> Callable[[F], F]:
    """Declares that `plain` does the same as a kernel, bit for bit; what is declared is a `Kernel`."""
    declared: Callable[[F], Any] = lambda compiled: Kernel(compiled, plain)  # noqa: E731
    return declared


def or_interpreted(**instead: Function) -> Callable[[F], F]:
    """Declares that a kernel's own text gives the same bits when it is interpreted: it has few steps, all in float64,
    or in types that it names.  `instead`: what to call in place of functions of those names, which have many."""
    declared: Callable[[F], Any] = lambda compiled: Kernel(compiled, interpreted(compiled, instead))  # noqa: E731
    return declared


def interpreted(kernel: Any, instead: dict[str, Function]) -> Function:
    """Returns the Python function of a kernel, in which those that it calls are Python functions, too."""
    function = kernel.py_func
    scope = dict(function.__globals__)
    for name in function.__code__.co_names:
        if isinstance(scope.get(name), Dispatcher):
            scope[name] = instead[name] if name in instead else interpreted(scope[name], instead)
    return FunctionType(function.__code__, scope, function.__name__, function.__defaults__)
