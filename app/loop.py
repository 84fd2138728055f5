"""Opens the window and runs it.

Until the first frame is on the screen nothing of the engine is loaded; it then loads on the worker's thread.  The
window's own modules load while the window system and the graphics driver set up, which needs no interpreter.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import imgui_bundle  # before glfw, so that both use one libglfw

import glfw  # isort: skip

from app.faults.endings import Signals, hear_display_loss
from app.faults.file_guard import guard_files
from app.faults.log import log_file, open_log
from app.input.window_box import fitted_box, kept_window_file, read_box
from app.trace import trace

if TYPE_CHECKING:
    from app.window import Window
    from engine.studio.worker import Worker

assert imgui_bundle
WIDTH, HEIGHT = 1280, 800
GRACE = 10.0  # seconds that the engine has to carry out what was posted, once the program is asked to end
SWITCH = 0.0005  # seconds after which a thread that computes lets another have the interpreter


class WindowError(RuntimeError):
    """The window cannot be opened; one line that says why."""


def run(path: str | None = None, play: str | None = None) -> int:
    """Opens the window, on a file if there is one; `play`: a recording that is replayed live.  The exit status.

    WindowError if there is no display or no OpenGL 3.3.
    """
    window = opened_window()
    if path is None and play is None:
        window.desk.start.welcome()
    window.frame()
    trace("first frame")
    open_log()
    guard_files()
    sys.setswitchinterval(SWITCH)
    _connect(window)
    signals = Signals(glfw.post_empty_event)
    hear_display_loss(lambda: _leave(window))
    for name, live in ((path, False), (play, True)):
        if name is not None:
            window.desk.open(Path(name), live)
    ended = False
    try:
        while not window.closed() and not signals.asked:
            window.wait(window.frame())
    finally:
        try:
            window.hide()
            chosen = window.desk.asked.quit
            ended = window.engine.worker.close(None if chosen else GRACE, by_choice=chosen)  # files are still written
        finally:
            window.close()
    status = _told(window.engine.worker, ended)
    return status if ended else _go(status)


def _leave(window: Window) -> NoReturn:
    """Ends the program when its window is gone already: nothing may be drawn or given back any more."""
    status = 1
    try:
        window.let_go()
        ended = window.engine.worker.close(GRACE, by_choice=False)
        status = _told(window.engine.worker, ended)
    finally:
        _go(status)


def _go(status: int) -> NoReturn:
    """Ends the process at once, whatever its threads are at."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError):
            stream.flush()
    os._exit(status)


def _told(worker: Worker, ended: bool = True) -> int:
    """Tells the terminal what went wrong when no window was there any more to show it; the exit status."""
    from engine.studio.results import Note

    faults = [result for result in worker.results() if isinstance(result, Note) and result.bad]
    if not ended:
        faults.append(Note("what was asked for last is not carried out yet; it is kept", bad=True))
    for fault in faults:
        print(f"inkfall: {fault.text}{f': {log_file()} tells more' if fault.fault else ''}", file=sys.stderr)
    return 1 if faults else 0


def opened_window() -> Window:
    """Returns the window, nothing drawn yet.  WindowError if there is no display, no OpenGL 3.3, or a library is
    missing."""
    rest = threading.Thread(target=_load, args=("app.window",))
    rest.start()
    handle = _open_window()
    rest.join()
    try:
        from app.window import Window
    except ImportError as error:
        raise WindowError(f"its libraries cannot be loaded: {error}") from None
    return Window(handle)


def _load(name: str) -> None:
    """Loads a module ahead of its use, which will tell what is wrong if that fails."""
    with contextlib.suppress(ImportError):
        importlib.import_module(name)


def _connect(window: Window) -> None:
    from engine.journal.heads import head_of_new
    from engine.journal.journal import Journal
    from engine.studio.journalled.posts import Posts
    from engine.studio.worker import Worker

    window.connect(lambda before: Worker(window.pace.told, posts=Posts(Journal(head_of_new())), before=before))


def _open_window() -> Any:
    glfw.set_error_callback(_glfw_error)
    if not glfw.init():
        raise WindowError("no display: the window system cannot be reached")
    hints = (
        (glfw.CONTEXT_VERSION_MAJOR, 3),
        (glfw.CONTEXT_VERSION_MINOR, 3),
        (glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE),
        (glfw.OPENGL_FORWARD_COMPAT, True),
        (glfw.DEPTH_BITS, 0),
        (glfw.STENCIL_BITS, 0),
        (glfw.SCALE_TO_MONITOR, True),
    )
    for hint, value in hints:
        glfw.window_hint(hint, value)
    glfw.window_hint_string(glfw.X11_CLASS_NAME, "inkfall")
    handle = glfw.create_window(*_place_as_before(), "Inkfall", None, None)
    if not handle:
        glfw.terminate()
        raise WindowError("no window: OpenGL 3.3 is not there")
    glfw.make_context_current(handle)
    glfw.swap_interval(1)
    return handle


def _place_as_before() -> tuple[int, int]:
    """Has the window come up where it lay last, if that is still on a screen; returns its width and height."""
    box = read_box(kept_window_file())
    area, maximised = box or ((0, 0, WIDTH, HEIGHT), False)
    (x, y, width, height), seen = fitted_box(area, [glfw.get_monitor_workarea(one) for one in glfw.get_monitors()])
    if seen and box is not None:
        glfw.window_hint(glfw.POSITION_X, x)
        glfw.window_hint(glfw.POSITION_Y, y)
    glfw.window_hint(glfw.MAXIMIZED, maximised)
    return width, height


def _glfw_error(code: int, text: Any) -> None:
    """GLFW's errors are of no use to the artist; the call that failed says so itself."""
    if os.environ.get("INKFALL_TRACE_GLFW"):
        print(f"glfw {code}: {text!r}", file=sys.stderr)
