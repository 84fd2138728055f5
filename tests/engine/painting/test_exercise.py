"""What is exercised so that its kernels are compiled does what it says, and leaves nothing behind."""

from engine.brush import tip
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.strokes import likeness
from engine.studio.preparing import exercise


def test_a_painting_is_saved_exported_and_opened_in_a_folder_that_goes_again(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    opened = []
    for name in ("open_painting", "open_image"):
        real = getattr(exercise, name)
        monkeypatch.setattr(exercise, name, lambda path, real=real: opened.append((path, real(path))))
    exercise.run({"kind": "files"})
    assert [path.name for path, _ in opened] == ["painting.ora", "picture.png"]
    for path, found in opened:
        assert path.parent.parent == tmp_path
        assert composite(found.painting.root, 0, Rect.at(0, 0, 64, 64), layer_planes).max() > 0.5
    assert list(tmp_path.iterdir()) == []


def test_tips_are_laid_mirrored_too_and_fills_on_a_torus(tmp_path, monkeypatch):
    """Kernels that would be compiled as the first such stroke or fill is made, on the thread that paints."""
    called = []
    for module, name in ((tip, "_lay_copies"), (likeness, "region_around")):
        real = getattr(module, name)
        monkeypatch.setattr(module, name, lambda *given, real=real, name=name: (called.append(name), real(*given))[1])
    exercise.draw_once(c.parse({"do": "stroke", "points": [[0, 0]], "brush": {"tip": "rock"}}).brush)
    assert set(called) == {"_lay_copies"}
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    exercise.run({"kind": "files"})
    assert called[-2:] == ["region_around"] * 2  # gaps open and closed
