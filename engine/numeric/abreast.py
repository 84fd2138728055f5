"""Kernels that take the channels of a pixel at once: what they do with one after another becomes one step.

numba keeps LLVM from that unless it is told for all that is compiled, which takes longer and seldom helps.  No sum is
reckoned in another order, so the bits are the same.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from numba import config

from engine.numeric.kernel import kernel

MadeT = TypeVar("MadeT", bound=Callable[..., object])


def abreast(function: MadeT) -> MadeT:
    """Compiles a function that Python calls, with the same steps for values that lie side by side."""
    made = kernel(function)
    compiler = made._compiler  # type: ignore[attr-defined]
    plainly = compiler.compile

    def compiled(*signature: object) -> object:  # one thread at a time compiles
        before, config.SLP_VECTORIZE = config.SLP_VECTORIZE, 1
        try:
            return plainly(*signature)
        finally:
            config.SLP_VECTORIZE = before

    compiler.compile = compiled
    return made
