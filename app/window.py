"""The window: one frame after another, drawn when there is something new to see."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from imgui_bundle import imgui  # before glfw, so that both use one libglfw

import glfw  # isort: skip
import moderngl
from imgui_bundle.imgui import backends

from app import cursor, guide_marks, mask_veil, theme
from app.actions.binding import lay_keys
from app.actions.file_actions import close
from app.callbacks import Callbacks
from app.canvas.gallery import Gallery
from app.canvas.overlay import Overlay
from app.canvas.screen import Screen
from app.canvas.view import Place, View
from app.decoration import Decoration
from app.desk.desk import Desk, Hear
from app.desk.examples.thumbnails import Shelf
from app.desk.files import Files
from app.desk.holding.palette_shelf import PALETTES, bring_palette
from app.desk.holding.size_lock import follow_view
from app.desk.keys.kept_keys import kept_keys_file, read_keys
from app.desk.moving import floating, held_box
from app.desk.outside import bringing
from app.desk.places import going
from app.desk.preferring.preferred import Preferred
from app.desk.preferring.speaking import SpeakLanguage, spoken
from app.desk.previews import Previews
from app.desk.proofing.proof_work import make_tables
from app.desk.recovery.engine_thread import EngineThread, Start
from app.desk.recovery.recovery_work import FindCards
from app.desk.remembering.kept_views import ReadViews, ViewsWatched
from app.desk.remembering.kept_window import Remembering, read_window, restore_window
from app.desk.sharing.preset_work import BRUSHES, bring_preset
from app.desk.stock import TakeStock
from app.drawing import Drawing
from app.faults.fault_guard import FaultGuard
from app.input.events import PenEvent
from app.input.pointers import Pointers
from app.input.window_box import box_of_window, kept_window_file
from app.land.land_screen import LandScreen
from app.land.land_wants import LandWants
from app.language.wide_fonts import load_language_names
from app.news import News
from app.pace import BLINK, IDLE, Pace
from app.panels.controls.folds import keep_folds_in
from app.panels.guides.assistant_marks import draw_assistants
from app.panels.layout import Layout
from app.panels.moving import box_marks, frame_marks
from app.panels.strip import STRIPS
from app.resting import LOOK, Resting
from app.router import Router
from app.solid_view import SolidView
from app.trace import TRACED, trace_typing
from app.wanted_tiles import Tiles
from engine.keeping.preferences import Preferences, preferences_file, read_preferences
from engine.studio import results
from engine.studio.selecting.ants_records import Ants
from engine.studio.selecting.tint_records import Tint
from engine.studio.worker import Worker

_FAULT = results.Note("A fault in Inkfall", True, fault=True, stays=True, offers=("copy_details",), about="fault")
DOUBLE = 0.5  # seconds from one click to the next, at most, that are a double click


def _ants(desk: Desk, ants: Ants, _now: float) -> None:
    desk.selecting.hear(ants)


def _resize(desk: Desk, ctx: moderngl.Context, width: int, height: int) -> None:
    """Gives the view and the card the size that the window has, pixels."""
    if (width, height) != (desk.view.width, desk.view.height) and width > 0 and height > 0:
        desk.view = desk.view.resized(width, height)
        ctx.screen.viewport = (0, 0, width, height)
        ctx.viewport = (0, 0, width, height)


def _flush() -> Callable[[], None]:
    """Returns OpenGL's own, which moderngl has not."""
    address = ctypes.cast(glfw.get_proc_address("glFlush"), ctypes.c_void_p).value or 0
    flush: Callable[[], None] = ctypes.CFUNCTYPE(None)(address)
    return flush


def _typed() -> str | None:
    """Returns what stands in the text field that has the keyboard, None where imgui has none."""
    field = imgui.internal.get_input_text_state(imgui.internal.get_active_id())
    return None if field is None else field.get_text()


def _keys_wait() -> bool:
    """Tells whether keys are left for the next frame: imgui takes one a frame."""
    return len(imgui.get_current_context().input_events_queue) > 0


def _look(screen: float, preferences: Preferences) -> tuple[float, float, str]:
    """Gives all beside the canvas the preferred look and sizes on a screen of so many pixels per point; pixels per
    point then, the font's size, and the look that was chosen."""
    wished = _wished(screen, preferences)
    theme.apply(*wished)
    return wished


def _screen_scale(handle: Any) -> float:
    """Returns the pixels per point of the screen that a window is on."""
    return max(0.75, float(glfw.get_window_content_scale(handle)[0]))


def _wished(screen: float, preferences: Preferences) -> tuple[float, float, str]:
    return screen * preferences.scale, preferences.font_size, preferences.look


def _lay_kept(desk: Desk) -> tuple[str, ...]:
    """Lays on the desk what was kept of the last session, and has keys and folds be as they were; a line for each file
    that is at fault."""
    kept, fault = read_window(kept_window_file())
    restore_window(desk, kept)
    desk.keys.bound, keys_fault = read_keys(kept_keys_file())
    lay_keys(desk.keys.bound)
    keep_folds_in(desk.remembered.folded)
    return tuple(one for one in (fault, keys_fault) if one)


_ANTS: dict[type, Hear] = {Ants: _ants}


class Window:
    """A GLFW window whose context is current, and imgui on it; everything happens on the thread that made it."""

    def __init__(self, handle: Any) -> None:
        self.handle = handle
        self.ctx = moderngl.create_context(require=330)
        self.pace = Pace(self.ctx.info["GL_RENDERER"])
        imgui.create_context()
        io = imgui.get_io()
        io.set_ini_filename("")
        io.config_flags |= imgui.ConfigFlags_.no_mouse_cursor_change
        io.mouse_double_click_time, io.mouse_single_click_delay = DOUBLE, 1.1 * DOUBLE
        theme.load_fonts(io)
        load_language_names()
        preferences = read_preferences(preferences_file())[0]  # the engine tells what is wrong with them
        self._look = _look(_screen_scale(handle), preferences)
        spoken(*SpeakLanguage(preferences.language).carry_out())  # before anything is drawn
        width, height = glfw.get_framebuffer_size(handle)
        self.desk = Desk(View(Place(0, 0, 0), 0, 0.0, max(1, width), max(1, height)), self._not_yet, self._look[0])
        self.desk.preferred = Preferred(preferences, preferences)
        self.desk.graphics = f"{self.ctx.info['GL_RENDERER']}, {self.ctx.info['GL_VERSION']}"
        self._guard = FaultGuard(lambda: self.desk.told(_FAULT))
        self._faults = _lay_kept(self.desk)
        self._remembering, self._views = (
            Remembering(lambda: box_of_window(handle, _screen_scale(handle)), STRIPS),
            ViewsWatched(),
        )
        self.layout = Layout(self._guard)
        self.router = Router(self.desk, self.layout)
        self.pointers, self._resting = Pointers(handle), Resting()
        address = ctypes.cast(handle, ctypes.c_void_p).value or 0
        self._callbacks = Callbacks(handle, self.router, self.pace.event, partial(_before, self), self._dropped)
        backends.glfw_init_for_opengl(address, False)
        backends.opengl3_init("#version 330")
        self.screen = Screen(self.ctx)
        self.tiles, self.gallery = Tiles(self.screen), Gallery(self.ctx, self.desk.pictures)
        self._solid, self._land = SolidView(self.ctx, self.gallery), LandWants()
        self._drawing, self._decoration = (
            Drawing(handle, self.screen, Overlay(self.ctx), LandScreen(self.ctx, _flush())),
            Decoration(handle),
        )
        self.news = News(self.desk, self._guard, self._hearers, self.layout.hearers)
        self._files: Files | None = None
        self._laid_out = False  # whether panels were: only then the free area is known

    def _not_yet(self, _request: Any) -> None:
        self.desk.say("The paint engine is still loading")

    def _hearers(self, kind: type) -> list[Hear]:
        """Returns those of its parts who hear results of a type."""
        if kind is results.Picture:
            return [
                lambda desk, picture, now: self.gallery.hang(picture.ident, picture.pixels),
                lambda desk, picture, now: desk.awaited.come(picture.ident),
            ]
        if kind is results.PicturePart:
            return [lambda desk, part, now: self.gallery.touch(part.ident, part.size, part.area, part.pixels)]
        if kind is Tint:
            return [lambda desk, tint, now: mask_veil.hang(desk, self.gallery, tint)]
        return [
            hears[kind] for hears in (self.tiles.hears, self._land.hears, self.engine.hears, _ANTS) if kind in hears
        ]

    def _dropped(self, path: Path) -> bool:
        """Takes a file that was dropped on the window: it is a panel's, or a picture or
        layers to bring in, or it is opened.  False while it cannot be."""
        desk = self.desk
        if not desk.known.ready:
            self._not_yet(None)
            return False
        with self._guard.spare("on a drop"):
            if not self.layout.strip.dropped(desk, path, *self.pointers.at()):
                if path.suffix.lower() in BRUSHES:
                    bring_preset(desk, path)
                elif path.suffix.lower() in PALETTES:
                    bring_palette(desk, path)
                elif bringing.is_picture(path) or bringing.is_layered(path):
                    bringing.offer(desk, path, desk.view.to_canvas(*self.pointers.at()))
                else:
                    desk.guard(lambda: desk.open(path))
        return True

    def connect(self, start: Start) -> None:
        """From now on pens are heard, and requests go to the engine's thread, which `start` begins."""
        self.pointers.hear_pens(self.desk.preferred.now.driver)
        shelf, previews = Shelf(glfw.post_empty_event), Previews(glfw.post_empty_event)
        self.desk.thumbnails = shelf.ask
        self._files = files = Files(glfw.post_empty_event)
        self._beside: tuple[Shelf | Previews | Files, ...] = (shelf, previews, files)
        self.desk.work = files.post
        self.desk.previews = previews.ask
        self.engine = EngineThread(self.desk, start, self.router.lift, self._taken)
        for source in (self.engine.news, shelf.take, previews.take, files.take):
            self.news.connect(source)
        self.desk.work(FindCards())  # first: its pictures are to be seen at once
        self.desk.work(ReadViews())
        self.desk.work(TakeStock(self.desk.remembered.kept, self._faults))
        make_tables(self.desk, self.desk.preferred.now)

    def _taken(self, worker: Worker, again: bool) -> None:
        """Works with an engine's thread; `again`: it has the painting back that is on the screen."""
        self.pace.worker = worker
        self.tiles.stays = again

    def frame(self) -> bool:
        """Takes in what happened and draws; True while something still moves."""
        desk, now, spare = self.desk, time.monotonic(), self._guard.spare
        seconds = self.pace.begin(now)
        _resize(self.desk, self.ctx, *glfw.get_framebuffer_size(self.handle))
        self._catch_up(self.pointers.events_in_order)
        if came := self.news.take(now):
            self.pace.news(now)
        if self._files is not None and (told := desk.trial.heard(*self.pointers.heard())):
            desk.say(told)
        moving = desk.glide.moving
        with spare("on the view's way"):
            desk.view = desk.glide.step(desk.view, seconds)
            moving = desk.land.step(seconds, now) or moving
            follow_view(desk)
            going.watch(desk, now)
            self._views.watch(desk, now)
            self._remembering.watch(desk, now)
            self._land.begin(desk, now, self._drawing)
        self._panels()
        with spare("asking for what is to be seen"):
            if desk.known.ready:
                self._land.wants(desk, now)
                if not desk.land.on:
                    self.tiles.wants(desk)
                floating.want_rim(desk)
                held_box.wants(desk)
                self.layout.wants(desk, now)
        if desk.painting and self.news.take_from((self.engine.paint,), now):  # what came of this frame's points
            self.pace.news(now)
        with spare("drawing the picture"):
            self._decoration.show(desk, self.router.panning_key)
            if desk.strip == "solid":
                self._solid.show(desk.solid)
            exposed, self._callbacks.exposed = self._callbacks.exposed, False
            moving = self._drawing.draw(desk, now, self.gallery.fresh(), exposed) or moving
        self.pace.end(self._drawing.drawn, moving, desk.known.growing is not None, self._drawing.lacks)
        moves = self.desk.keys.stirred() or moving or _keys_wait()
        self._resting.stirs = came or moves or self._drawing.changed
        return moves

    def _catch_up(self, events: Callable[[], Sequence[PenEvent]]) -> None:
        """Sees to keys that GLFW has told, and to what the pointer did after them: before the key that it tells of now,
        if there is one, as a stroke ends before what a key does to it."""
        found: Sequence[PenEvent] = ()
        if self.desk.known.presets:  # kept until there is a brush to paint with
            with self._guard.spare("on an event of the window system"):  # what its callbacks raised
                found = events()
        with self._guard.spare("on a key"):
            self._callbacks.deliver()
        for event in found:
            self.pace.event()
            self._resting.presses += event.kind not in ("move", "lost")
            with self._guard.spare("on what the pointer did"):
                self.router.pointer(event)

    def _panels(self) -> None:
        preferences = self.desk.preferred.now
        scale = _screen_scale(self.handle)  # another one, once the window is on another screen
        if _wished(scale, preferences) != self._look:
            self._look = _look(scale, preferences)
            self.desk.scale = self._look[0]
        backends.opengl3_new_frame()
        backends.glfw_new_frame()
        imgui.new_frame()
        with self._guard.spare_drawing("drawing the canvas's marks"):
            self._marks()
        with self._guard.spare_drawing("laying out the panels"):
            self.layout.draw(self.desk, "Pen" if self.desk.pointer.pen else "")
            self.router.hover()
            held_box.hover(self.desk)
        if not self._laid_out:
            self._laid_out = True
            self.desk.fit()
        imgui.render()

    def _marks(self) -> None:
        """Draws what lies over the canvas; over the land, the brush's outline alone."""
        if self.desk.land.on:
            cursor.draw_outline(self.desk)
            return
        mask_veil.draw_veil(self.desk)
        cursor.draw_frame(self.desk)
        cursor.draw_growing(self.desk)
        draw_assistants(self.desk)
        guide_marks.draw_guides(self.desk)
        cursor.draw_outline(self.desk)
        cursor.draw_ghost(self.desk)
        guide_marks.draw_copies(self.desk)
        cursor.draw_shape(self.desk)
        guide_marks.draw_path(self.desk)
        box_marks.draw(self.desk)
        frame_marks.draw_frame_marks(self.desk)

    def wait(self, moving: bool) -> None:
        """Sleeps until the next frame; `moving`: what the last one gave."""
        idle = BLINK if imgui.get_io().want_text_input or self.desk.selecting.selected else IDLE
        if TRACED:
            trace_typing(imgui.get_io().want_text_input, _typed())
            self._resting.keys = self._callbacks.taken
            done = self.engine.worker.settled and not any(one.busy for one in self._beside)
            self._resting.look((self.desk.pointer.x, self.desk.pointer.y), done, self.engine.kept)
            idle = idle if self._resting.rests and self._resting.kept else LOOK
        with self._guard.spare("on an event of the window system"):  # what its callbacks raised
            self.pace.wait(moving or (TRACED and self._resting.soon), self.desk.painting, idle)

    def closed(self) -> bool:
        """Tells whether the window is to go; asks about unsaved changes first."""
        if glfw.window_should_close(self.handle):
            glfw.set_window_should_close(self.handle, False)
            with self._guard.spare("closing"):
                close(self.desk)
        return self.desk.asked.quit

    def hide(self) -> None:
        """Takes it from the screen; ends the stroke in hand, and waits for the files that it writes."""
        if self._files is not None:
            with self._guard.spare("on the end of the session"):
                self._views.end(self.desk)
                self._remembering.end(self.desk)
        glfw.hide_window(self.handle)
        glfw.poll_events()
        self.let_go()

    def let_go(self) -> None:
        """Ends the stroke in hand, which stays, and waits for the files that it writes."""
        with self._guard.spare("on the end of a stroke"):
            for event in self.pointers.events() if self.router.gesture is not None else ():
                self.router.pointer(event)
            self.router.lift()
        if self._files is not None:
            self._files.close()

    def close(self) -> None:
        """Gives back pen, card and window."""
        self.pointers.close()
        backends.opengl3_shutdown()
        backends.glfw_shutdown()
        imgui.destroy_context()
        glfw.destroy_window(self.handle)
        glfw.terminate()


def _before(window: Window, scancode: int | None) -> None:
    window._catch_up(partial(window.pointers.events_before, scancode))
