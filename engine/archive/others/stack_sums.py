"""The layers that other programs are told, with the sums of their pictures."""

from __future__ import annotations

from dataclasses import replace

from engine.files.stack_xml import StackEntry


def with_sums(stack: StackEntry, sums: dict[str, str]) -> StackEntry:
    """Returns the tree with the SHA-256 of each layer's picture: shows later whether another program changed it."""
    children = tuple(
        with_sums(child, sums)
        if isinstance(child, StackEntry)
        else replace(child, ours={**child.ours, "sha256": sums[child.src]})
        for child in stack.children
    )
    return replace(stack, children=children)
