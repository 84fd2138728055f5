"""The texture doctor's dialog: an example, what each maker makes of it, and which one suits it."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.desk import Desk
from app.desk.outside import doctoring
from app.language import said
from app.panels.controls import widgets as w
from engine.studio.textures.texture_requests import DoctorAsk
from engine.studio.textures.texture_results import DoctorScene, DoctorTrial

_COLUMNS = 4
_SIDE = 150.0  # of a picture, points
_LONGEST = "quasi-periodic, structured"  # of the kinds that are told
_WAYS = {
    "scattered": ("Scattered", "Even grain that never repeats; nothing is copied"),
    "histograms": ("Histograms", "Grain of the right colours; nothing is copied"),
    "statistics": ("Statistics", "Edges and lines go on; nothing is copied"),
    "objects": ("Objects", "Stones, leaves and bricks stay what they are"),
    "full": ("Full layout", "As near to the example as can be; small pieces are copied"),
    "pieces": ("Pieces", "Large pieces of the example that agree at their edges: bricks, cloth, leaves"),
    "grown": ("Grown example", "More of the same while you paint, with its own rim"),
}
_NAMED = {**{way: title for way, (title, _) in _WAYS.items()}, "paper": "Paper", "colour": "A plain colour"}


class DoctorDialog:
    """Shows what is tried, as it comes, and takes the picture in the way that is clicked."""

    title = "What suits this example?"

    def __init__(self, desk: Desk) -> None:
        self._flat = False

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is answered."""
        scene = desk.match.doctored
        trials = {trial.way: trial for trial in scene.trials} if scene is not None else {}
        taken = ""
        left, step = imgui.get_cursor_pos_x(), _column(desk)
        self._cell(desk, "example", ("Example", "The part that is looked at"), _kinds(scene), (False, False))
        for n, (way, words) in enumerate(_WAYS.items(), 1):
            if n % _COLUMNS:
                imgui.same_line(left + n % _COLUMNS * step)
            trial, best = trials.get(way), scene is not None and scene.advice == way
            if self._cell(desk, way, words, _measured(trial), (best, trial is not None and not trial.fault)):
                taken = way
        self._words(desk, scene, _COLUMNS * step - imgui.get_style().item_spacing.x)
        if self._buttons(desk, scene):
            return False
        if taken:
            doctoring.follow_advice(desk, taken, self._flat)
            desk.post(DoctorAsk(""))
        return not taken

    def _cell(self, desk: Desk, name: str, words: tuple[str, str], below: str, state: tuple[bool, bool]) -> bool:
        """Draws a picture with its name and a line below; `state`: whether it is the best one, and can be taken.  Tells
        whether it was clicked."""
        (title, hint), (best, usable), side = words, state, _SIDE * desk.scale
        imgui.begin_group()
        corner = imgui.get_cursor_screen_pos()
        shown = desk.pictures.get(f"doctor {name}") if usable or (name == "example" and below) else None
        w.picture(shown, (side, side), f"{hint}\nClick to paint with it" if usable else hint, name=f"doctor {name}")
        clicked = usable and imgui.is_item_clicked()
        if best or (usable and imgui.is_item_hovered()):
            end = ImVec2(corner.x + side, corner.y + side)
            colour = theme.packed(theme.look.accent if best else theme.look.quiet)
            imgui.get_window_draw_list().add_rect(
                corner, end, colour, imgui.get_style().frame_rounding, 2.5 * desk.scale
            )
        if best:
            said.text_colored(theme.vec(theme.look.accent), title)
        else:
            said.text_unformatted(title)
        said.text_disabled(below or "…")
        imgui.end_group()
        return clicked

    def _words(self, desk: Desk, scene: DoctorScene | None, wide: float) -> None:
        """Two lines are kept for the sentence, so that nothing moves when it comes."""
        corner, line = imgui.get_cursor_pos(), imgui.get_text_line_height_with_spacing()
        imgui.push_text_wrap_pos(corner.x + wide)
        if scene is not None and scene.fault:
            said.text_colored(theme.vec(theme.look.warn), scene.fault)
        else:
            said.text_wrapped(scene.why if scene is not None and scene.why else "All makers are being tried…")
        imgui.pop_text_wrap_pos()
        imgui.set_cursor_pos(ImVec2(corner.x, corner.y + 2 * line))
        imgui.dummy(ImVec2(wide, 0))

    def _buttons(self, desk: Desk, scene: DoctorScene | None) -> bool:
        """Draws what can be done besides; True when the dialog is answered."""
        crooked = scene is not None and bool(scene.light or scene.slant)
        imgui.begin_disabled(not (crooked or self._flat))
        hint = "Takes out light that falls off over the picture, and a slanted view"
        changed, self._flat = w.tick("Set straight", self._flat, hint)
        imgui.end_disabled()
        if changed:
            doctoring.look_at(desk, self._flat)
        wide = imgui.get_font_size() * 10
        advice = scene.advice if scene is not None else ""
        imgui.same_line()
        good = bool(advice) and advice != "colour"
        label = f"Take {_NAMED[advice]}###take" if good else "Take###take"
        if w.default_button(label, "Paints with the one that suits it", enabled=good, width=1.3 * wide):
            doctoring.follow_advice(desk, advice, self._flat)
            desk.post(DoctorAsk(""))
            return True
        imgui.same_line()
        if w.text_button("As paper", "The brush feels it, as it is", width=wide, enabled=bool(scene and scene.kinds)):
            doctoring.follow_advice(desk, "paper", self._flat)
            desk.post(DoctorAsk(""))
            return True
        imgui.same_line()
        if w.text_button("Cancel", "Leave the brush as it is", width=wide):
            desk.post(DoctorAsk(""))
            return True
        return False


def _column(desk: Desk) -> float:
    """How far apart columns begin: what is written below a picture, as it comes, moves none of them."""
    widest = max(said.calc_text_size(words).x for words in (_LONGEST, "0.00 apart, 100% copied"))
    return max(_SIDE * desk.scale, widest) + imgui.get_style().item_spacing.x


def _kinds(scene: DoctorScene | None) -> str:
    """Names what the example is, as far as there is room below it."""
    return (
        "" if scene is None else ", ".join(scene.kinds[:2] if "inhomogeneous" not in scene.kinds else scene.kinds[:1])
    )


def _measured(trial: DoctorTrial | None) -> str:
    if trial is None:
        return ""
    return trial.fault[:28] if trial.fault else f"{trial.apart:.2f} apart, {trial.copied:.0%} copied"
