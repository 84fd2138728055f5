"""The status line: what happens, where in depth the view is, what is still being computed."""

from __future__ import annotations

import math
import time

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.actions import ACTIONS, perform
from app.canvas.view import zoom_text
from app.desk.desk import Desk
from app.desk.land.land_state import error_text
from app.language import said
from app.language.words import say
from app.panels import notice_line, selection_chip
from app.panels.controls import widgets as w
from app.panels.controls.fitting import ended
from app.tools.tools import TOOLS
from engine.studio.held.held_records import Held
from engine.studio.results import Opening

_LEVEL = "The level of detail shown and painted on; each level is twice as fine.  Click to type or copy a place"
_LAND = (
    "Wheel: fly there.  Middle button or Space: turn.  Right button: look around.  Tools work where they meet the land"
)
_ERROR = "How far the land lies from where it is drawn, as a rule and at most, in pixels of the window"
_NARROW = 70.0  # ems of a line in which a notice needs the room of what can wait
_MEGABYTE = 1 << 20
_PROOF = 5.0  # ems of what is told of profiles: what lies beside it stays when it changes
_PATIENCE = 0.4  # seconds for which it is not worth a word that the engine gets ready


def draw(desk: Desk, pointer_name: str) -> None:
    """Fills the present window, one line high."""
    left = imgui.get_cursor_pos_x()
    right = imgui.get_window_width() - imgui.get_style().window_padding.x
    imgui.dummy(ImVec2(0, 0))
    narrow = imgui.get_window_width() < _NARROW * imgui.get_font_size()
    crowded = bool(desk.notices.rows) and narrow
    memory = [] if narrow else [_memory(desk.known.held)]
    for label, hint, fixed, action in reversed(memory + _fields(desk, pointer_name, crowded)):
        width = max(said.calc_text_size(label).x, fixed * imgui.get_font_size())
        right -= width
        imgui.same_line(right)
        said.text_unformatted(label)
        if label:
            w.named(f"status: {label}")
        if action and imgui.is_item_hovered():
            _underline()
            if imgui.is_mouse_clicked(imgui.MouseButton_.left):
                perform(desk, ACTIONS[action])
        w.tooltip(hint)
        right -= 1.4 * imgui.get_font_size()
    right = selection_chip.draw(desk, right) - 0.7 * imgui.get_font_size()
    right = notice_line.count_button(desk, right, 2 if crowded else 1)
    imgui.same_line(left)
    _left(desk, right)


def _left(desk: Desk, right: float) -> None:
    """Draws what is told, up to `right`: what has just happened, then what went wrong, else what can be done here."""
    if desk.known.opening is not None:
        _opening(desk, desk.known.opening)
    held = desk.notices.seen and imgui.is_window_hovered()  # somebody may be about to press one of its buttons
    desk.notices.seen = False
    if _says(desk) and not (held and desk.notices.rows):
        _message(desk, right)
    elif desk.notices.rows:
        desk.notices.seen = True
        notice_line.draw(desk, right)
    elif desk.known.opening is not None:
        imgui.dummy(ImVec2(0, 0))
    elif desk.examples.swapping:
        name = desk.examples.entry.title if desk.examples.entry else ""
        said.text_unformatted(f"Click on a painted texture: it becomes “{name}”  (Esc: not now)")
    elif desk.past.asking:
        said.text_unformatted("Click a place: the strokes that show there are listed  (Esc: not now)")
    elif desk.known.filming is not None:
        _offer(desk, f"Filming, {desk.known.filming * 100:.0f} %", "stop_film")
    elif desk.known.playing is not None:
        _offer(desk, f"Playing {desk.known.title}, {desk.known.playing * 100:.0f} %", "stop_playing")
    elif desk.places.lost and not desk.painting:
        _offer(desk, "No paint in sight", "nearest")
    elif desk.stack.only is not None and desk.known.ready:
        only = desk.stack.only
        _offer(desk, f"Only “{only}” is seen", "show_all")
    elif not desk.known.ready:
        said.text_disabled("Loading the paint engine…")
    else:
        said.text_disabled(ended(say(now_possible(desk)), right - imgui.get_cursor_pos_x()))


def now_possible(desk: Desk) -> str:
    """Returns what the tool in hand does now, in a line: on masks the brush does something else than on paint."""
    tool = TOOLS[desk.hand.tool]
    if desk.selecting.masking and tool.outline:
        taken, added = "Take from what is selected", "Paint what is selected, erase what is not; colours do not count"
        return taken if desk.hand.erasing else added
    if desk.land.on:
        return _LAND
    if desk.masks.on(desk.known.active) and tool.outline:
        return "Hide with the eraser" if desk.hand.erasing else "Paint on the mask: black hides, white shows again"
    if desk.hand.erasing:
        return "Erase with the chosen brush"
    return tool.hint if tool.told is None else tool.told(desk)


def _opening(desk: Desk, opening: Opening) -> None:
    """Draws how far a file is opened, and what gives that up, which stays where it is."""
    left, em = imgui.get_cursor_pos_x(), imgui.get_font_size()
    text = f"Opening {opening.name}"
    said.text_unformatted(f"{text}  {opening.part * 100:.0f} %" if opening.part else text)
    w.named(text)
    w.tooltip("You can go on painting meanwhile")
    imgui.same_line(left + said.calc_text_size(f"{text}  100 %").x + 0.7 * em)
    pressed = said.small_button("Stop")
    w.named("Stop")
    w.tooltip("Do not open it; the painting stays  (Escape)")
    if pressed:
        desk.stop_opening()
    imgui.same_line(0, 2 * em)


def _says(desk: Desk) -> bool:
    """Tells whether there is a message, and it still holds."""
    message = desk.message
    return time.monotonic() < message.until and (
        not message.offers or desk.painting or any(ACTIONS[offer].when(desk) for offer in message.offers)
    )


def _message(desk: Desk, right: float) -> None:
    """Draws it up to `right`, with a button for what it offers; where it is too long, the text ends earlier."""
    text, bad, offered = desk.message.text, desk.message.bad, desk.message.offers
    sign = f"{icons.WARNING}  " if bad else ""
    offers = [offer for offer in offered if ACTIONS[offer].when(desk)]
    pad = imgui.get_font_size() + 2 * imgui.get_style().frame_padding.x
    buttons = sum(said.calc_text_size(ACTIONS[offer].title).x + pad for offer in offers)
    shown = ended(say(sign + text), right - imgui.get_cursor_pos_x() - buttons)
    said.text_colored(theme.vec(theme.look.warn if bad else theme.look.text), shown)
    w.named(text)
    if shown != say(sign + text):
        w.tooltip(text)
    for offer in offers:
        _button(desk, offer)


def _offer(desk: Desk, text: str, action: str) -> None:
    """Draws a line that holds for now, with a button for an action."""
    said.text_unformatted(text)
    w.named(text)
    _button(desk, action)


def _button(desk: Desk, offer: str) -> None:
    imgui.same_line(0, imgui.get_font_size())
    pressed = said.small_button(ACTIONS[offer].title)
    w.named(ACTIONS[offer].title)
    w.tooltip(ACTIONS[offer].hint)
    if pressed:
        perform(desk, ACTIONS[offer])


def _underline() -> None:
    """Shows that the item just drawn can be clicked."""
    corner, end = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    imgui.get_window_draw_list().add_line(ImVec2(corner.x, end.y), end, theme.packed(theme.look.text))


def _work(desk: Desk) -> str:
    """Returns what goes on beside the painting."""
    if desk.known.writing.files:
        word = "Saving" if desk.known.writing.saving else "Writing"
        grown = f", growing {desk.known.writing.grown * 100:.0f} %" if desk.known.writing.grown < 1.0 else ""
        return f"{icons.DISK} {word}{grown}"
    if desk.known.preparing is not None and time.monotonic() - desk.known.preparing > _PATIENCE:
        return f"{icons.WAIT} examples: getting ready"
    if desk.arriving.name:
        return f"{icons.WAIT} bringing in"
    brushes = desk.known.prepared
    if brushes.ready < brushes.of:
        return f"{icons.WAIT} Preparing brushes, {brushes.ready} of {brushes.of}"
    if desk.known.growing is not None:
        return f"growing {desk.known.growing.done * 100:.0f} %"
    return "refining" if desk.known.pending else ""


def _memory(held: Held) -> tuple[str, str, float, str]:
    """Returns the field that tells what memory the program takes, and who holds it."""
    if not held.resident:
        return "", "", 0.0, ""
    known = sum(size for _, size in held.rows)
    rows = [*held.rows, ("The program itself", max(held.resident - known, 0))]
    told = [f"{_megabytes(size):>6}  {say(name)}" for name, size in rows if size >= _MEGABYTE or name == "Painting"]
    more = [f"Put away on disk: {_megabytes(held.disk)}"] if held.disk >= _MEGABYTE else []
    last = f"Paintings may take {_megabytes(held.budget)}; preferences.toml says how much"
    return _megabytes(held.resident), "\n".join(["Memory", *told, *more, last]), 0.0, ""


def _megabytes(size: int) -> str:
    return f"{size / _MEGABYTE:,.0f} MB"


def _fields(desk: Desk, pointer_name: str, crowded: bool = False) -> list[tuple[str, str, float, str]]:
    """(text, hint, least width in ems, what a click does), left to right; `crowded`: as little as will do."""
    view, work = desk.view, _work(desk)
    hint = "What is still being computed, or written; you can go on painting"
    out = [
        (icons.WAIT, f"{work}.  {hint}", 0.0, "") if crowded and work else (work, hint, 6.0, ""),
        ("" if crowded else pointer_name, "The device that last moved the pointer", 0.0, ""),
    ]
    if view.angle or view.mirrored:
        turned = f"{math.degrees(view.angle):.0f}°" if view.angle else ""
        out.append(
            (f"{turned} {'mirrored' if view.mirrored else ''}".strip(), "How the view is turned (5: upright)", 0.0, "")
        )
    shown, told = desk.proofing.words()
    if shown:
        out.append((shown, told, _PROOF, "soft_proof"))
    if desk.land.on:
        out.append((error_text(desk.land), _ERROR, 0.0, ""))
    out += [
        (f"Level {view.shown_level}", _LEVEL, 4.2, "type_place"),
        (zoom_text(view.level, view.fraction), "How much the painting is magnified (F: fit, 1: one to one)", 6.5, ""),
    ]
    return out
