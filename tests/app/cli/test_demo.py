"""`inkfall demo` where there is no display, and the recording that it plays."""

import json

from command_line import pixels

from app.__main__ import main
from app.cli import demo
from engine.painting.recording import read


def test_demo_without_a_display_writes_files(script, tmp_path, capsys, monkeypatch):
    places = tmp_path / "demo.json"
    places.write_text('{"zoom": [[0, 0, 0, 64, 48], [3, 150, 130, 90, 60]]}')
    monkeypatch.setattr(demo, "RECORDING", script)
    monkeypatch.setattr(demo, "PLACES", places)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.chdir(tmp_path)
    assert main(["demo"]) == 0
    told = capsys.readouterr().out
    assert "No display" in told
    assert "inkfall-demo/" in told
    out = tmp_path / "inkfall-demo"
    assert sorted(p.name for p in out.iterdir()) == ["demo-zoom-00.png", "demo-zoom-01.png", "demo.ora", "demo.png"]
    assert pixels(out / "demo-zoom-01.png").shape == (60, 90, 4)
    assert main(["demo", "--out", str(tmp_path / "other"), "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["written"]) == 4


def test_the_bundled_demo_is_a_recording_with_places_to_zoom_to():
    found = read(demo.RECORDING)
    assert len(found.commands) > 10
    places = json.loads(demo.PLACES.read_text())["zoom"]
    assert len(places) >= 4
    for place in places:
        assert len(place) == 5
        assert all(isinstance(value, int) for value in place)
        assert min(place[3:]) >= 1
