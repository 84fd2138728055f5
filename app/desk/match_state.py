"""The matching panel as the window knows it: examples, settings, the texture that is being made for use."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from immutables import Map

from app.desk.knots import Knots
from engine.numeric.address import Rect
from engine.studio.requests import Request
from engine.studio.textures.texture_requests import MatchSet, MatchUse
from engine.studio.textures.texture_results import DoctorScene, MatchScene

SIZES = (128, 256, 512)
LEVELS, ORIENTATIONS, ITERATIONS = 4, 4, 5
STAGES = 5  # of a series that goes with the pen's pressure
SMALLEST = 8  # pixels along a side of an example
_PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff")

_Curve = str | Knots | None
Spot = tuple[int, int | None]  # a subband: level, orientation


@dataclass(slots=True)
class MatchState:
    """`examples`: the one to match, and one to mix with it, as members of the texture command, None where there is
    none; `bands`: gain and curve of the subbands that were changed; `marking`: the example for which a rectangle of
    the canvas is to be drawn; `marked`: that rectangle while it is drawn, corners in framebuffer pixels;
    `awaited`: what is to be done with which texture once it is made; `structure`, `between`: how much of the structure
    is kept, of one example and of the average of two."""

    examples: list[Map[str, Any] | None] = field(default_factory=lambda: [None, None])
    size: int = 256
    levels: int = LEVELS
    orientations: int = ORIENTATIONS
    iterations: int = ITERATIONS
    seed: int = 0
    structure: str = "objects"
    between: str = "statistics"
    how: str = "average"
    weight: float = 0.5
    split: int = 2
    pressed: bool = False  # the weight goes with the pen's pressure
    bands: dict[Spot, tuple[float, _Curve]] = field(default_factory=dict)
    axes: list[float] = field(default_factory=lambda: [1.0, 1.0, 1.0, 1.0])
    chosen: Spot = (0, 0)
    marking: int | None = None
    marked: tuple[float, float, float, float] | None = None
    spots: dict[int, tuple[float, float, float, float]] = field(
        default_factory=dict
    )  # where examples are dropped; 2 is the panel
    awaited: tuple[str, str] | None = None
    scene: MatchScene | None = None
    doctored: DoctorScene | None = None  # what is known of the picture that the texture doctor looks at
    _posted: tuple[str, Map[str, Any] | None] | None = None

    @property
    def mixing(self) -> bool:
        """Tells whether there is a second example."""
        return self.examples[1] is not None

    @property
    def maker(self) -> str:
        """Returns names the maker that what is set needs."""
        return "mix" if self.mixing else "match"

    @property
    def by_pressure(self) -> bool:
        """Tells whether what is used is a series."""
        return self.pressed and self.mixing and self.how == "average"

    @property
    def kept(self) -> str:
        """Returns how much of the structure is kept of what is set: "none" where two are not averaged."""
        if not self.mixing:
            return self.structure
        return self.between if self.how == "average" else "none"

    def keep(self, structure: str) -> None:
        """Keeps so much of the structure, of one example or of both."""
        if self.mixing:
            self.between = structure
        else:
            self.structure = structure

    def arguments(self) -> Map[str, Any] | None:
        """Returns the members of the texture command; None without an example."""
        first, second = self.examples
        if first is None:
            return None
        given: dict[str, Any] = {**first, "size": (self.size, self.size), "detail": "learnt"}
        usual = {"seed": 0}
        if self.kept == "none":
            usual |= {"levels": LEVELS, "orientations": ORIENTATIONS, "iterations": ITERATIONS}
        else:
            given |= {"structure": self.kept}
        given |= {name: getattr(self, name) for name, value in usual.items() if getattr(self, name) != value}
        if second is not None:
            given |= {"pattern": second.get("path", second), "how": self.how}
            if self.how != "palette":
                given |= {"weight": self.weight} if self.how == "average" else {"split": self.split}
        if self.kept != "none":
            return Map(given)
        bands = tuple(_band(*item) for item in sorted(self.bands.items(), key=repr) if item[1] != (1.0, None))
        given |= {"bands": bands} if bands else {}
        given |= {"axes": tuple(self.axes)} if any(factor != 1.0 for factor in self.axes) else {}
        return Map(given)

    def show(self, index: int, example: Map[str, Any] | None) -> None:
        """Takes another example; taken away, the other takes its place."""
        self.examples[index], self.marking = example, None
        if self.examples[0] is None:
            self.examples = [self.examples[1], None]

    def show_file(self, index: int, path: Path) -> None:
        """Takes a picture file as example 0 or 1."""
        self.show(index, Map({"path": str(path.absolute())}))

    def show_area(self, index: int, level: int, rect: Rect) -> None:
        """Takes a rectangle of the canvas as example 0 or 1."""
        self.show(index, Map({"rect": (level, rect.x0, rect.y0, rect.width, rect.height)}))

    def dropped(self, path: Path, x: float, y: float) -> bool:
        """Takes a picture that was dropped on an example's place, or elsewhere on the panel, where it is the first;
        False if it is none or was dropped on something else."""
        for index, (x0, y0, x1, y1) in self.spots.items():
            if x0 <= x < x1 and y0 <= y < y1 and path.suffix.lower() in _PICTURES:
                self.show_file(index if index < 2 and self.examples[0] is not None else 0, path)
                return True
        return False

    def reshape(self, levels: int, orientations: int) -> None:
        """A pyramid of another shape has other subbands."""
        if (levels, orientations) != (self.levels, self.orientations):
            self.levels, self.orientations = levels, orientations
            self.bands, self.chosen = {}, (0, 0)

    def ask(self, post: Callable[[Request], None]) -> None:
        """Posts what was set, when it has changed."""
        now = self.maker, self.arguments()
        if now != self._posted:
            self._posted = now
            post(MatchSet(*now))

    def use(self, post: Callable[[Request], None], how: str, name: str) -> None:
        """Asks for a texture under a name, to be the brush's ink, its dry brush or its paper."""
        arguments = self.arguments()
        if arguments is None:
            return
        if self.by_pressure:
            arguments = arguments.set("stages", STAGES)
        self.awaited = how, name
        post(MatchUse(name, self.maker, arguments))


def _band(spot: Spot, change: tuple[float, _Curve]) -> Map[str, Any]:
    level, orientation = spot
    gain, curve = change
    given: dict[str, Any] = {"level": level, "gain": gain}
    given |= {} if orientation is None else {"orientation": orientation}
    return Map(given | ({} if curve is None else {"shaping": curve}))


def title(example: Map[str, Any]) -> str:
    """Returns what an example is called."""
    if "path" in example:
        return Path(example["path"]).name
    level, _, _, width, height = example["rect"]
    return f"Canvas, level {level}, {width} × {height}"
