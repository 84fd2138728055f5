"""The window: one frame after another, drawn when there is something new to see."""

from __future__ import annotations

import ctypes
import time
from pathlib import Path
from typing import Any

from imgui_bundle import imgui  # before glfw, so that both use one libglfw

import glfw  # isort: skip
import moderngl
from imgui_bundle.imgui import backends

from app import cursor, theme
from app.actions import close
from app.canvas.overlay import Overlay
from app.canvas.screen import Plan, Screen
from app.canvas.view import Place, View
from app.desk import example_work
from app.desk.desk import Desk
from app.desk.files import Files
from app.desk.stock import TakeStock
from app.desk.thumbnails import Shelf
from app.input.choose import pen_source
from app.input.events import PointerSource
from app.input.glfw_events import GlfwPointer
from app.news import News
from app.pace import Pace
from app.panels.layout import Layout
from app.router import Router
from engine.studio.requests import Open
from engine.studio.worker import Worker


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
        self.scale = max(0.75, glfw.get_window_content_scale(self.handle)[0])
        theme.load_fonts(io)
        theme.apply(self.scale)
        width, height = glfw.get_framebuffer_size(self.handle)
        self.desk = Desk(View(Place(0, 0, 0), 0, 0.0, max(1, width), max(1, height)), self._not_yet, self.scale)
        self.layout = Layout()
        self.router = Router(self.desk, self.layout)
        self.mouse: PointerSource = GlfwPointer(self.handle)
        self.pen: PointerSource | None = None
        self.files: Files | None = None
        self._callbacks()
        address = ctypes.cast(self.handle, ctypes.c_void_p).value or 0
        backends.glfw_init_for_opengl(address, False)
        backends.opengl3_init("#version 330")
        self._address = address
        self.screen, self.overlay = Screen(self.ctx), Overlay(self.ctx)
        self.news = News(self.desk, self.screen, self.ctx)
        self._keys: list[tuple[int, int, int, int]] = []
        self._characters: list[int] = []
        self._cursors: dict[int, Any] = {}
        self._cursor = 0
        self._plan: Plan | None = None  # of the canvas, as it was last drawn
        self._drawn, self._exposed = False, True
        self._title = ""

    def _not_yet(self, _request: Any) -> None:
        self.desk.say("The paint engine is still loading")

    def _callbacks(self) -> None:
        """Keys and text go to imgui and to the router; focus and size only mark the frame as old."""
        w = self.handle
        glfw.set_key_callback(w, self._key)
        glfw.set_char_callback(w, self._typed)
        glfw.set_window_focus_callback(w, self._focus)
        glfw.set_cursor_enter_callback(w, self._entered)
        glfw.set_window_refresh_callback(w, self._refresh)
        glfw.set_framebuffer_size_callback(w, lambda *_: self.pace.event())
        drop: Any = self._dropped  # gets a list of names
        glfw.set_drop_callback(w, drop)

    def _key(self, _w: Any, key: int, scancode: int, action: int, mods: int) -> None:
        self.pace.event()
        typing = imgui.get_io().want_text_input or self.layout.dialogs.open
        if key != glfw.KEY_TAB or typing:  # Tab would put the focus into a field, which then took all keys
            backends.glfw_key_callback(self._address, key, scancode, action, mods)
        self._keys.append((key, scancode, action, mods))

    def _typed(self, _w: Any, character: int) -> None:
        """What may be a key of the canvas waits for what the pointer did: a press may have given the focus to a field,
        and a field that opens later must not get it."""
        if self.router.typing:
            backends.glfw_char_callback(self._address, character)
        else:
            self._characters.append(character)

    def _focus(self, _w: Any, focused: int) -> None:
        self.pace.event()
        backends.glfw_window_focus_callback(self._address, focused)
        if not focused:
            self.router.lost_focus()

    def _refresh(self, _w: Any) -> None:
        """The window system has lost what the window showed."""
        self.pace.event()
        self._exposed = True

    def _entered(self, _w: Any, entered: int) -> None:
        self.pace.event()
        if not entered:
            self.router.left()

    def _dropped(self, _w: Any, paths: Any) -> None:
        self.pace.event()
        if not paths or not self.desk.known.ready:
            return
        x, y = self._pointer()
        taken = self.desk.strip == "match" and self.desk.panels and self.desk.match.dropped(Path(paths[0]), x, y)
        taken = taken or example_work.dropped(self.desk, Path(paths[0]))
        if not taken:
            self.desk.guard(lambda: self.open(Path(paths[0])))

    def _pointer(self) -> tuple[float, float]:
        """Where the pointer is, framebuffer pixels: while something is dragged, no pointer events tell."""
        x, y = glfw.get_cursor_pos(self.handle)
        width, height = glfw.get_window_size(self.handle)
        return x * self.desk.view.width / max(width, 1), y * self.desk.view.height / max(height, 1)

    def open(self, path: Path, live: bool = False) -> None:
        """Opens a file; `live`: a recording is seen as it grows."""
        self.desk.post(Open(path, live))

    def connect(self, worker: Worker) -> None:
        """From now on pens are heard, and requests go to the engine's thread."""
        self.pen = pen_source(self.handle)
        self.desk.post, self.pace.worker = worker.post, worker
        self.news.worker = worker
        self.news.shelf = Shelf(glfw.post_empty_event)
        self.news.files = self.files = Files(glfw.post_empty_event)
        self.desk.work = self.files.post
        self.desk.work(TakeStock())

    def frame(self) -> bool:
        """Takes in what happened and draws; True while something still moves."""
        now = time.monotonic()
        seconds = self.pace.begin(now)
        self._resize()
        for source in (self.pen, self.mouse):
            for event in source.events() if source is not None else ():
                self.pace.event()
                self.router.pointer(event)
        keys, self._keys = self._keys, []
        for key in keys:  # after the pointer: a stroke ends before what a key does to it
            self.router.key(*key)
        characters, self._characters = self._characters, []
        for character in characters if self.router.typing else ():
            backends.glfw_char_callback(self._address, character)
        if self.news.take(now):
            self.pace.news(now)
        moving = self.desk.glide.moving
        self.desk.view = self.desk.glide.step(self.desk.view, seconds)
        self._panels()
        imgui.render()
        self.news.ask(now)
        self._show_cursor()
        moving = self._draw(now) or moving
        self.pace.end(self._drawn, moving, self.desk.known.growing is not None)
        return moving

    def _draw(self, now: float) -> bool:
        """Draws, if anything is to be seen that is not on the screen; True while something fades."""
        desk, data = self.desk, imgui.get_draw_data()
        plan = self.screen.plan(desk.view, desk.known.frame, now, desk.insets)
        told = self.overlay.look(data, (desk.view.width, desk.view.height), self.news.gallery.fresh())
        self._drawn = told or plan != self._plan or self._exposed
        if self._drawn:
            self._plan, self._exposed = plan, False
            self.overlay.redraw(data)
            self.screen.draw(plan)
            self.overlay.draw(data)
            glfw.swap_buffers(self.handle)
        return plan.moving

    def _resize(self) -> None:
        width, height = glfw.get_framebuffer_size(self.handle)
        view = self.desk.view
        if (width, height) != (view.width, view.height) and width > 0 and height > 0:
            self.desk.view = view.resized(width, height)
            self.ctx.screen.viewport = (0, 0, width, height)
            self.ctx.viewport = (0, 0, width, height)

    def _panels(self) -> None:
        backends.opengl3_new_frame()
        backends.glfw_new_frame()
        imgui.new_frame()
        cursor.draw_frame(self.desk)
        cursor.draw_growing(self.desk)
        cursor.draw_outline(self.desk)
        self.layout.draw(self.desk, "Pen" if self.desk.pointer.pen else "")
        self.router.hover()
        if self.news.first_layout():
            self.desk.fit()

    def _show_cursor(self) -> None:
        wanted = cursor.shape(self.desk, self.router.panning_key)
        if wanted != self._cursor:
            self._cursor = wanted
            if wanted not in self._cursors:
                self._cursors[wanted] = glfw.create_standard_cursor(wanted)
            glfw.set_cursor(self.handle, self._cursors[wanted])
        known = self.desk.known
        title = f"{'*' if known.modified else ''}{known.path.name if known.path else 'Untitled'} - Inkfall"
        if title != self._title:
            self._title = title
            glfw.set_window_title(self.handle, title)

    def wait(self, moving: bool) -> None:
        """Sleeps until the next frame; `moving`: what the last one gave."""
        self.pace.wait(moving, self.desk.painting, imgui.get_io().want_text_input)

    def closed(self) -> bool:
        """Whether the window is to go; asks about unsaved changes first."""
        if glfw.window_should_close(self.handle):
            glfw.set_window_should_close(self.handle, False)
            close(self.desk)
        return self.desk.asked.quit

    def hide(self) -> None:
        """Takes it from the screen; waits for the files that it writes."""
        glfw.hide_window(self.handle)
        glfw.poll_events()
        if self.files is not None:
            self.files.close()

    def close(self) -> None:
        self.router.cancel()
        if self.pen is not None:
            self.pen.close()
        backends.opengl3_shutdown()
        backends.glfw_shutdown()
        imgui.destroy_context()
        glfw.destroy_window(self.handle)
        glfw.terminate()
