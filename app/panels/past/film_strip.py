"""The steps of the painting as two rows of cards: runs of strokes of one brush, and the steps of one run."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime

from imgui_bundle import ImVec2, imgui

from app import icons
from app.desk.desk import Desk
from app.desk.guides import symmetry
from app.desk.past.past_state import Run, step_name, when
from app.language import said
from app.language.words import say
from app.panels.past import step_card
from app.panels.past.step_card import Look
from engine.studio.past.past_records import PastStep

_GO = "Click: the painting is as it was after this; all can be done again.  Right click: only look"


_ICONS = {
    "selection": icons.SELECT_BOX,
    "fill": icons.FILL,
    "move": icons.MOVE,
    "mask": icons.MASK,
    "merge": icons.MERGE,
    "copy": icons.COPY,
    "delete": icons.DELETE,
    "picture": icons.IMAGE,
    "placement": icons.LINK,
    "frame": icons.AREA,
    "guide": icons.GUIDES,
    "solid": icons.SOLID,
    "layer": icons.LAYERS,
}


class FilmStrip:
    """Draws the rows.  `pictures`: the indices of the steps in sight."""

    def __init__(self) -> None:
        self.pictures: list[int] = []
        self._at: tuple[int, int] | None = None  # steps in all, and done, when it was last drawn

    def draw(self, desk: Desk) -> None:
        """Draws into the present window."""
        past, scene = desk.past, desk.past.scene
        self.pictures = []
        moved, self._at = self._at != (len(scene.steps), scene.done), (len(scene.steps), scene.done)
        runs = past.runs
        if not runs:
            imgui.spacing()
            said.text_disabled("Nothing is painted yet, or it is not known how")
            return
        now = next((n for n, run in enumerate(runs) if run.last.number >= scene.done), len(runs) - 1)
        if moved:
            past.opened = runs[now].steps[0].number
        first = past.opened
        chosen = next((n for n, run in enumerate(runs) if run.steps[0].number == first), now)
        tall = step_card.size(desk.scale, 2)[1]
        self._row(desk, "runs", len(runs), tall, (now if moved else None, lambda n: self._run(desk, runs[n], n == now)))
        steps = runs[chosen].steps
        at = min(max(scene.done - steps[0].number, 0), len(steps) - 1)
        imgui.separator()
        tall = step_card.size(desk.scale, 1)[1]
        show = at if moved else None
        self._row(desk, "steps", len(steps), tall, (show, lambda n: self._step(desk, steps[n])))

    def _row(
        self, desk: Desk, name: str, count: int, tall: float, cards: tuple[int | None, Callable[[int], None]]
    ) -> None:
        """Draws those of `count` cards that are in sight; `cards`: the one that is brought into sight, and what draws
        one."""
        shown, draw = cards
        wide = step_card.size(desk.scale, 1)[0] + imgui.get_style().item_spacing.x
        bar = imgui.get_style().scrollbar_size
        imgui.begin_child(name, ImVec2(0, tall + bar), 0, imgui.WindowFlags_.horizontal_scrollbar)
        room = imgui.get_window_width()
        imgui.set_cursor_pos(ImVec2(0, 0))
        corner = imgui.get_cursor_pos()
        imgui.dummy(ImVec2(count * wide, 1))
        if shown is not None:
            imgui.set_scroll_x(max(0.0, (shown + 0.5) * wide - room / 2))
        scroll = imgui.get_scroll_x()
        for n in range(max(0, int(scroll // wide)), min(count, int((scroll + room) // wide) + 1)):
            imgui.set_cursor_pos(ImVec2(corner.x + n * wide, corner.y))
            draw(n)
        imgui.end_child()

    def _run(self, desk: Desk, run: Run, now: bool) -> None:
        past, last, count = desk.past, run.last, len(run.steps)
        name = step_name(last, desk.known.presets)
        sign = _ICONS.get(last.sign)
        lines = name if sign is None else f"{sign} {name}", when(last.time, datetime.now())
        seen = past.looking is not None and run.steps[0].number <= past.looking <= last.number
        look = Look(now, seen, run.steps[0].number > past.scene.done, count)
        label = f"run {run.steps[0].number}"
        strokes = f"{count} fills" if last.sign == "fill" else f"{count} strokes"
        what = f"{count} steps" if last.brush is None else strokes
        hint = f"{say(name)}, {say(what)}.  {say(_GO)}" if count > 1 else f"{say(name)}.  {say(_GO)}"
        press = step_card.draw(label, self._picture(desk, last), lines, look, hint)
        if press:
            past.opened = run.steps[0].number
        self._go(desk, press, last.number)

    def _step(self, desk: Desk, step: PastStep) -> None:
        past = desk.past
        look = Look(step.number == past.scene.done, step.number == past.looking, step.number > past.scene.done)
        lines = (f"{step.number}",)
        self._go(desk, step_card.draw(f"step {step.number}", self._picture(desk, step), lines, look, _GO), step.number)

    def _go(self, desk: Desk, press: str, number: int) -> None:
        if press == "right":
            desk.past.look(desk.post, number)
        elif press:
            symmetry.keep(desk)
            desk.past.jump(desk.post, number)

    def _picture(self, desk: Desk, step: PastStep) -> object | None:
        self.pictures.append(step.index)
        return desk.pictures.get(step.picture)
