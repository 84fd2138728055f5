"""What is still to be laid on the desk of what the window remembers, and what was kept of it last."""

from __future__ import annotations

from dataclasses import dataclass, field

from app.desk.remembering.window_record import KeptWindow
from engine.painting.places import Bookmark


@dataclass(slots=True)
class Remembered:
    """`kept`: as the file has it; `strip`: what was open below the canvas, until it is again; `folded`: by sections of
    panels, whether they are open; `views`: by the files of paintings, what was seen of them last, the newest last."""

    kept: KeptWindow = KeptWindow()  # noqa: RUF009  # it never changes
    strip: str = ""
    folded: dict[str, bool] = field(default_factory=dict)
    views: dict[str, Bookmark] = field(default_factory=dict)
