"""One layer seen alone, in place of the painting."""

from __future__ import annotations

from collections.abc import Callable

from engine.canvas import layers
from engine.canvas.layers import Group
from engine.checks.owned import Owned
from engine.painting.difference import Areas
from engine.studio import requests as q
from engine.studio.stack.stack_requests import ShowOnly


class LayerAlone(Owned):
    """It belongs to the engine's thread.  `changed` is told that all of the picture is another one."""

    def __init__(self, changed: Callable[[Areas], None]) -> None:
        self._name: str | None = None
        self._of: Group | None = None  # layers of which one was seen alone last, and
        self._shown: Group | None = None  # what was shown of them
        self._changed = changed
        self.handlers: q.Handlers = {ShowOnly: self._show}

    def forget(self) -> None:
        """Shows the painting."""
        self._name = self._of = self._shown = None

    def seen(self, root: Group) -> Group:
        """Returns what is seen of the layers `root`: the same object for the same layers."""
        if self._name is None:
            return root
        if self._shown is None or self._of is not root:
            node = next((node for node in layers.walk(root) if node.name == self._name), None)
            self._of, self._shown = root, root if node is None else layers.alone(node, root)
        return self._shown

    def _show(self, request: ShowOnly) -> None:
        if request.name != self._name:
            self.forget()
            self._name = request.name
            self._changed(lambda level: None)
