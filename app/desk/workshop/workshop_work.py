"""Written textures as files: one small text each, that the command line reads as it is."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path, PurePath

import platformdirs

from app.desk.desk import Desk, FileWork
from app.desk.workshop.workshop_state import USUAL_PERIOD, WRITTEN, TextTold
from engine.texture.expression.library.bundled_texts import generator_library, written_library
from engine.texture.expression.library.lesson_texts import lessons
from engine.texture.expression.written import STAGES_LEAST, STAGES_MOST, USUAL_STAGES

TEXT = ".inktexture"  # the ending of a written texture
TEXTS = (TEXT, ".txt")
_BYTES_MOST = 1 << 16
_LONGEST = 60  # letters of a name
_TOLD = re.compile(r"^// (period|stages) (\d+(?:\.\d+)?)[ \t]*\n", re.MULTILINE)


def own_texts() -> Path:
    """Tells where written textures are kept."""
    return platformdirs.user_data_path("inkfall") / "textures"


def own_path(name: str) -> Path:
    """Returns the file in which a texture of one's own is kept, called as it is as far as files may be."""
    return own_texts() / f"{text_stem(name)}{TEXT}"


def text_stem(name: str) -> str:
    """Returns a texture's name as its file may be called."""
    told = "".join(ch if ch.isalnum() or ch in " -_" else "-" for ch in " ".join(name.split()))
    return told[:_LONGEST].strip(" -") or WRITTEN


@dataclass(frozen=True, slots=True)
class ListTexts(FileWork):
    """Looks which texts are kept, and which come along."""

    def carry_out(self) -> tuple[str, ...]:
        """Returns the paths of those that are kept, by name."""
        written_library(), generator_library(), lessons()  # read now, on this thread
        folder = own_texts()
        return tuple(sorted(map(str, folder.glob(f"*{TEXT}")))) if folder.is_dir() else ()

    def arrive(self, desk: Desk, found: tuple[str, ...]) -> None:
        """Lists them."""
        desk.workshop.files = found
        desk.workshop.library, desk.workshop.lessons = tuple(written_library().values()), lessons()
        desk.workshop.generators = tuple(generator_library().values())
        if not desk.workshop.text:
            desk.workshop.take(lessons()[0].text)


@dataclass(frozen=True, slots=True)
class ReadText(FileWork):
    """Opens one in the workshop."""

    path: PurePath

    def carry_out(self) -> tuple[str, TextTold]:
        """Returns its text, and what it tells beside that."""
        data = Path(self.path).read_bytes()
        if len(data) > _BYTES_MOST:
            raise OSError(f"{self.path.name}: found {len(data)} bytes, expected {_BYTES_MOST} at most")
        try:
            text = data.decode("utf-8-sig").replace("\r\n", "\n")
        except UnicodeDecodeError:
            raise OSError(f"{self.path.name}: found bytes that are no UTF-8, expected a text") from None
        told = {name: float(value) for name, value in reversed(_TOLD.findall(text))}
        stages = max(STAGES_LEAST, min(int(told.get("stages", USUAL_STAGES)), STAGES_MOST))
        return _TOLD.sub("", text, count=len(told)), TextTold(period=told.get("period", USUAL_PERIOD), stages=stages)

    def arrive(self, desk: Desk, found: tuple[str, TextTold]) -> None:
        """Puts it into the workshop."""
        text, told = found
        desk.strip = "workshop"
        desk.workshop.take(text, self.path.stem, told)


@dataclass(frozen=True, slots=True)
class WriteText(FileWork):
    """Keeps a text in a file."""

    path: Path
    text: str
    period: float
    stages: int = USUAL_STAGES

    def carry_out(self) -> tuple[str, ...]:
        """Writes it; returns all that are kept."""
        from engine.files.atomic import replacing  # here: it takes its time to load

        self.path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(self.path) as file:
            told = f"// period {self.period:g}\n" + (
                f"// stages {self.stages}\n" if self.stages != USUAL_STAGES else ""
            )
            file.write(f"{told}{self.text.rstrip()}\n".encode())
        return ListTexts().carry_out()

    def arrive(self, desk: Desk, found: tuple[str, ...]) -> None:
        """Tells it."""
        desk.workshop.files, desk.workshop.name = found, self.path.stem
        kept = self.path.parent == own_texts()
        desk.say(f"Kept “{self.path.stem}” among your textures" if kept else f"Wrote {self.path.name}")


def keep_text(desk: Desk, path: Path) -> None:
    """Keeps what is in the workshop in a file, its sliders as they stand."""
    state = desk.workshop
    desk.work(WriteText(path, state.settled_text, state.period, state.staged if state.scene.felt else USUAL_STAGES))
