"""Examples by their names, pictures to make some of, and paintings that have some."""

import numpy as np
from immutables import Map
from PIL import Image

from engine.numeric.address import Rect
from engine.studio.results import Scene


def named(desk, name):
    return next(entry for entry in desk.examples.entries if entry.name == name)


def picture(path, size=(40, 30), mode="RGBA"):
    pixels = np.random.default_rng(3).integers(0, 255, (size[1], size[0], 4)).astype(np.uint8)
    pixels[..., 3] = np.where(np.arange(size[0]) < size[0] // 2, 255, 0)
    Image.fromarray(pixels).convert(mode).save(path)
    return path


def scene_with(*definitions):
    rows = tuple((name, "example", Map(told)) for name, told in definitions)
    return Scene(Rect(0, 0, 100, 80), (), None, False, False, False, None, definitions=(("R", "rock", Map()), *rows))
