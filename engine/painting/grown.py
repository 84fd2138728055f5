"""Paintings whose examples are grown to the end: what is written, and what is looked at by what comes later, must not
depend on how far that had come."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace

from engine.canvas import layers
from engine.canvas.growth import Growth, Tell, is_settled, one_of
from engine.canvas.growth import settled as settled_growth
from engine.canvas.layers import Group, Layer
from engine.canvas.placing.placement import Placement
from engine.painting.value import Painting

MOST_THREADS = 8


@contextmanager
def threads(count: int | None = None) -> Iterator[Executor | None]:
    """Yields what grows examples on `count` threads, as many as there are cores if that is None; None for one."""
    count = min(os.cpu_count() or 1, MOST_THREADS) if count is None else count
    if count == 1:
        yield None
        return
    with ThreadPoolExecutor(count, "inkfall examples") as pool:
        try:
            yield pool
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise


def settled(painting: Painting, count: int | None = None, tell: Tell = lambda part: None) -> Painting:
    """Returns the same painting with all that is painted with examples as it will stay, grown on `count` threads;
    `tell` hears of the part that is done, from 0 on, if there is anything to do."""
    root = settled_root(painting.root, count, tell)
    return painting if root is painting.root else replace(painting, root=root)


def settled_root(root: Group, count: int | None = None, tell: Tell = lambda part: None) -> Group:
    """Returns the same layers, grown to the end."""
    found = waiting(root)
    if not found:
        return root
    tell(0.0)
    with threads(count) as pool:
        for n, layer in enumerate(found):
            growth = settled_growth(layer.growth, pool, one_of(tell, n, len(found)))
            root = layers.with_growth(root, layer.name, growth)
    return root


def settled_alone(root: Group, name: str) -> Group:
    """Returns a root that shows just the node of a name, grown to the end, and what its placements show."""
    placed = any(isinstance(node, Placement) for node in layers.walk(root))
    tree = settled_root(root) if placed else root
    return settled_root(layers.alone(layers.find(tree, name), tree))


def waiting(root: Group) -> list[Layer]:
    """Returns the layers on which something is still to be grown."""
    return [layer for layer in layers.layers(root) if not is_settled(layer.growth)]


def with_grown(root: Group, name: str, old: Growth, new: Growth) -> Group:
    """With `new` for the growth of a layer if that is `old`: the same one, further refined."""
    if not layers.has(root, name):
        return root
    node = layers.find(root, name)
    same = isinstance(node, Layer) and node.growth is old
    return layers.with_growth(root, name, new) if same else root
