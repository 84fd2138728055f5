"""`inkfall doctor`: what there is, and brushes made ready."""

import json

from app.__main__ import main
from engine.keeping import memory


def test_doctor_prepares_what_is_not_ready(tmp_path, monkeypatch, capsys):
    """One line on a pipe; what is ready is not done again; where nothing can be kept, that is said."""
    from engine.studio.preparing.noted import NOTE
    from engine.studio.preparing.processes import Preparing

    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    program = "import sys\nfor line in sys.stdin: print('{\"done\": true}', flush=True)"
    monkeypatch.setattr(Preparing.__init__, "__defaults__", (2, print, ("-c", program), True))
    assert main(["doctor", "--prepare"]) == 0
    assert capsys.readouterr() == ("all brushes are ready\n", "")
    assert len(json.loads((tmp_path / NOTE).read_text())["ready"]) >= 60
    monkeypatch.setattr(Preparing.__init__, "__defaults__", (2, print, ("-c", "raise SystemExit(1)"), True))
    assert main(["doctor", "--prepare"]) == 0
    capsys.readouterr()
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "none"))
    assert main(["doctor", "--prepare"]) == 1
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.count("\n") == 1
    assert "cannot be written to" in told.err


def test_doctor(capsys, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    assert main(["doctor", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["display"] == "none"
    assert isinstance(found["opengl"], str)
    assert main(["doctor"]) == 0
    assert "config" in capsys.readouterr().out


def test_it_tells_the_budget_of_memory_or_what_is_wrong_with_it(capsys, monkeypatch):
    told = []
    for word in ("512", "much"):
        memory.budget.cache_clear()
        monkeypatch.setenv(memory.VARIABLE, word)
        assert main(["doctor", "--json"]) == 0
        told.append(json.loads(capsys.readouterr().out)["memory"])
    memory.budget.cache_clear()
    assert told[0].startswith("512 MB")
    assert told[1] == memory.told_budget("much")[1]


def test_the_doctor_tells_who_may_hold_how_much(monkeypatch, capsys):
    monkeypatch.setattr("app.cli.doctor.opengl", lambda: "none")
    monkeypatch.setattr("app.cli.doctor.memory.budget", lambda: 512 << 20)
    assert main(["doctor", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["shares"]
    assert told == {"screen": "128 MB at most", "undo": "128 MB at most", "older steps": "64 MB at most"}
