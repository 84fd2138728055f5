"""The window in the colours of the screen's profile: what the card sends is what the table says."""

import ctypes as ct
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import ImageCms

from app.canvas.screen_colours import ScreenColours
from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.proofing.proof_state import ProofState
from app.desk.proofing.proof_work import MakeTables
from app.input.x_profile import x_profile
from engine.files.fault import FileError
from engine.files.profiles.icc_profile import profile_of
from engine.files.profiles.screen_table import NODES, ScreenTable, screen_table

RNG = np.random.default_rng(5)
SRGB = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()


def swapped():
    """A table that sends blue where red is meant."""
    colours = screen_table(profile_of(SRGB, "a")).colours
    return ScreenTable(np.ascontiguousarray(colours[..., ::-1]), "Swapped")


@pytest.mark.parametrize(("size", "told"), [((64, 48), (64, 48)), ((31, 17), (31, 17)), ((31, 17), (8, 8))])
def test_the_card_sends_what_the_table_says(context, size, told):
    """Also in a window that tells the size that it had at first."""
    pixels = RNG.integers(0, 256, (size[1], size[0], 3), np.uint8)
    colours = ScreenColours(context)
    for table, expected in ((screen_table(profile_of(SRGB, "a")), pixels), (swapped(), pixels[..., ::-1])):
        texture = context.texture(size, 3, pixels.tobytes(), alignment=1)
        target = context.framebuffer([texture])
        window = SimpleNamespace(size=told, use=target.use, read_into=target.read_into)
        colours.draw(table, target if told == size else window, size)
        found = np.frombuffer(target.read(alignment=1), np.uint8).reshape(pixels.shape)
        assert np.array_equal(found, expected)


def desk():
    return Desk(View(Place(0, 0, 0), 0, 0.0, 640, 480), lambda request: None)


def test_what_is_chosen_is_what_is_shown(tmp_path):
    path = tmp_path / "a.icc"
    path.write_bytes(SRGB)
    made, state = desk(), ProofState()
    assert state.words() == ("", "")
    MakeTables(str(path), str(path)).arrive(made, MakeTables(str(path), str(path)).carry_out())
    state = made.proofing
    assert state.shown is state.screen
    assert state.words()[0] == "Profile"
    state.on = True
    assert state.shown is state.proof
    assert (state.words()[0], state.proof.proof) == ("Soft proof", "sRGB built-in")
    assert MakeTables("none", "").carry_out() == (None, None)
    MakeTables("none", "").arrive(made, (None, None))
    assert (state.on, state.shown) == (False, None)
    state.proof = swapped()
    assert state.words()[0] == "Proof off"


def test_a_profile_that_is_none_is_told_and_colours_are_sent_as_they_are(tmp_path):
    path, made = tmp_path / "a.icc", desk()
    path.write_bytes(b"none")
    made.proofing.screen = swapped()
    with pytest.raises(FileError) as told:
        MakeTables(str(path), "").carry_out()
    MakeTables(str(path), "").fail(made, str(told.value))
    assert made.proofing.shown is None
    assert made.message.bad
    assert "\n" not in made.message.text
    assert str(path) in made.message.text


def test_the_profile_of_the_x_server_is_read(display, monkeypatch):
    assert x_profile(display) == b""
    put(display, SRGB)
    try:
        assert x_profile(display) == SRGB
        monkeypatch.setenv("DISPLAY", display)
        table, proof = MakeTables("screen", "").carry_out()
        assert (table.title, proof) == ("sRGB built-in", None)
    finally:
        put(display, b"")
    assert x_profile(":4711") == b""


def put(display, data):
    """Leaves a profile with an X server, as colour managers do."""
    x = ct.CDLL("libX11.so.6")
    x.XOpenDisplay.restype, x.XInternAtom.restype, x.XDefaultRootWindow.restype = ct.c_void_p, ct.c_ulong, ct.c_ulong
    connection = ct.c_void_p(x.XOpenDisplay(display.encode()))
    atom, cardinal = ct.c_ulong(x.XInternAtom(connection, b"_ICC_PROFILE", 0)), ct.c_ulong(6)
    root = ct.c_ulong(x.XDefaultRootWindow(connection))
    if data:
        x.XChangeProperty(connection, root, atom, cardinal, 8, 0, data, len(data))
    else:
        x.XDeleteProperty(connection, root, atom)
    x.XCloseDisplay(connection)


def test_nodes_are_all_in_the_table_of_places():
    assert NODES[0] == 0
    assert NODES[-1] == 255
    assert list(NODES) == sorted(set(NODES))
