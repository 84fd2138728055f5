"""The workshop as the window knows it: the text, what is looked at, and what the engine told of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from immutables import Map

from app.desk.workshop.inlined import text_set
from engine.painting.commands import DefineTexture
from engine.studio.requests import Request
from engine.studio.workshop.workshop_records import (
    WorkshopAsk,
    WorkshopScene,
    WorkshopSet,
    WorkshopValues,
    WorkshopWords,
)
from engine.texture.expression.library.bundled_texts import LibraryText, title_of
from engine.texture.expression.written import USUAL_STAGES, most_stages

_MAKER, WRITTEN = "expression", "Written"
USUAL_PERIOD, PERIODS = 64.0, (4.0, 4096.0)  # pixels: usual, and what may be set
_ALIGNED = 8  # pixels: of a multiple of that a picture begins, so that its coarser one fits
_FARTHEST = 40  # levels up and down


class TextTold(NamedTuple):
    """What is told of a text beside it: the values of its sliders, its period, and for how many pressures it is."""

    values: Map[str, float | str] = Map()
    period: float = USUAL_PERIOD
    stages: int = USUAL_STAGES


USUALLY = TextTold()
NOT_FELT = 1.0, 1.0, 0.0  # full pressure, far from the rim, to the right


@dataclass(slots=True)
class WorkshopState:
    """`name`: of the file or lesson that the text came from; `values`: of sliders that were moved; `put`: the editor is
    to take the text anew; `over`: the pixel of the level under the pointer; `use`: what is to be done with which
    texture once the painting has it."""

    text: str = ""
    name: str = ""
    values: Map[str, float | str] = Map()  # noqa: RUF009  # it never changes
    period: float = USUAL_PERIOD
    line: int = -1
    level: int = 0
    origin: tuple[int, int] = (0, 0)
    size: tuple[int, int] = (256, 256)
    lit: bool = False
    stages: int = USUAL_STAGES  # for how many pressures, and distances from the rim, strokes have it
    felt: tuple[float, float, float] = NOT_FELT  # the pressure, distance and direction of what is looked at
    put: bool = False
    nodes: bool = False  # whether the text is shown as nodes
    over: tuple[int, int] | None = None
    use: tuple[str, str] | None = None
    scene: WorkshopScene = WorkshopScene("")  # noqa: RUF009
    words: WorkshopWords = WorkshopWords()  # noqa: RUF009
    seen: WorkshopValues | None = None
    files: tuple[str, ...] | None = None  # that are kept; None: nobody has looked yet
    library: tuple[LibraryText, ...] = ()  # that come along,
    generators: tuple[LibraryText, ...] = ()  # and of these such as are for a stroke
    lessons: tuple[LibraryText, ...] = ()  # that teach, in order
    _posted: WorkshopSet | None = None
    _asked: tuple[int, int] | None = None

    @property
    def right(self) -> bool:
        """Tells whether the text is a texture, as far as is known."""
        return self.scene.mistake is None and self.scene.text == self.text and bool(self.scene.lines)

    @property
    def stages_most(self) -> int:
        """Gives for how many there may be: fewer where the text looks at more than one."""
        return most_stages(self.scene.felt)

    @property
    def staged(self) -> int:
        """Gives for how many there are."""
        return min(self.stages, self.stages_most)

    @property
    def wished(self) -> WorkshopSet:
        """Gives what is looked at."""
        looked = self.line, self.level, self.origin, self.size, self.lit, self.felt
        return WorkshopSet(self.text, self.values, self.period, *looked)

    def ask(self, post: Callable[[Request], None]) -> None:
        """Posts what was set, when it has changed, and where the pointer is."""
        if self.wished != self._posted:
            self._posted, self._asked = self.wished, None
            post(self._posted)
        if self.over != self._asked:
            self._asked = self.over
            post(WorkshopAsk(self.over))

    def take(self, text: str, name: str = "", told: TextTold = USUALLY) -> None:
        """Takes another text into the editor, which can be undone there."""
        self.text, self.name, (self.values, self.period, self.stages) = text, name, told
        self.line, self.put, self.felt = -1, True, NOT_FELT
        self.look(0, (0, 0))

    def edit(self, text: str) -> None:
        """The text is another one now, called as its first line says if that is another, too; where a line came or
        went, the texture is looked at."""
        if not text.strip() or title_of(text) not in ("", title_of(self.text)):
            self.name = title_of(text)
        if text.count("\n") != self.text.count("\n"):
            self.line = -1
        self.text = text

    @property
    def settled_text(self) -> str:
        """Gives the text with the values of sliders as its usual ones."""
        return text_set(self.text, self.values)

    def settle(self) -> None:
        """Writes the values of sliders into the text, as its usual ones."""
        self.text, self.values, self.put = self.settled_text, Map(), True

    def look(self, level: int, origin: tuple[int, int]) -> None:
        """Looks at another part of the texture."""
        self.level = max(-_FARTHEST, min(_FARTHEST, level))
        x, y = origin
        self.origin = x // _ALIGNED * _ALIGNED, y // _ALIGNED * _ALIGNED

    def zoom(self, finer: int, at: tuple[float, float]) -> None:
        """Looks so many levels nearer; what lies at a point of the picture, in pixels of it, stays there."""
        if not -_FARTHEST <= self.level + finer <= _FARTHEST:
            return
        place = [o + a for o, a in zip(self.origin, map(int, at), strict=True)]
        moved = [p << finer if finer >= 0 else p >> -finer for p in place]
        self.look(self.level + finer, (moved[0] - int(at[0]), moved[1] - int(at[1])))

    def value(self, name: str, usual: float | str) -> float | str:
        """Returns what a slider stands at."""
        found = self.values.get(name, usual)
        return found if isinstance(found, str) == isinstance(usual, str) else usual

    def definition(self, name: str, level: int = 0) -> DefineTexture:
        """Returns what defines the texture; its period is told in pixels of a level."""
        moved = {row[0]: self.value(row[0], row[1]) for row in self.scene.sliders if row[0] in self.values}
        told: dict[str, object] = {"text": self.text, "period": self.period}
        told |= {"values": Map(moved)} if moved else {}
        told |= {"level": level} if level else {}
        told |= (
            {"stages": self.staged} if self.scene.felt and self.staged != min(USUAL_STAGES, self.stages_most) else {}
        )
        return DefineTexture(name, _MAKER, Map(told))
