"""Choosing the layer that is painted on next."""

from __future__ import annotations

from dataclasses import replace

from app.desk.desk import Desk
from engine.painting.layer_commands import SelectLayer
from engine.studio.requests import Do


def choose_layer(desk: Desk, name: str) -> None:
    """Has a layer chosen, and takes it for chosen at once: a stroke that begins before the engine's answer would go to
    where the layer before, a placement perhaps, shows the pen's place."""
    desk.post(Do(SelectLayer(name)))
    scene = desk.known.scene
    if scene is not None and any(row.name == name for row in scene.layers):
        desk.learn(scene=replace(scene, active=name))
