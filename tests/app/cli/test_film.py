"""`inkfall film`: every format, whole or not there, and one line for what is wrong."""

import shutil
import signal
import subprocess
import time

import numpy as np
import pytest
from command_line import pixels, refused, start
from PIL import Image

from app.__main__ import main

FFMPEG = pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="needs ffmpeg")
FLIGHT = ("--flight", "3,200,160,64,48")


def made(source, out, *words):
    assert main(["film", str(source), str(out), *words]) == 0
    return out


@pytest.mark.parametrize("ending", [".webp", ".avif", ".gif", ".png"])
def test_animated_pictures(script, tmp_path, ending):
    with Image.open(made(script, tmp_path / f"a{ending}", "--seconds", "1", "--fps", "8")) as film:
        assert film.size == (64, 48)
        assert film.n_frames == 8
        first = np.asarray(film.convert("RGB")).astype(int)
        film.seek(7)
        last = np.asarray(film.convert("RGB")).astype(int)
    assert first.min() > 245  # paper
    assert (last < 200).any(axis=2).sum() > 500


def test_pictures_by_number(script, saved, tmp_path, capsys):
    made(saved, tmp_path / "a-%03d.png", *FLIGHT, "--seconds", "2", "--fps", "5")
    assert [path.name for path in sorted(tmp_path.iterdir())] == [f"a-{n:03}.png" for n in range(10)]
    assert "10 frames of 64 x 48, 2 s at 5 a second" in capsys.readouterr().out
    still = tmp_path / "still-%d.png"
    made(script, still, "--flight", "3,200,160,64,48", "--rect", "3,200,160,64,48", "--seconds", "1", "--fps", "1")
    assert np.array_equal(pixels(tmp_path / "a-009.png"), pixels(tmp_path / "still-0.png"))
    assert main(["export", str(saved), str(tmp_path / "e.png"), "--rect", "3,200,160,64,48"]) == 0
    with Image.open(tmp_path / "e.png") as exported:
        paper = Image.new("RGBA", exported.size, "white")
        paper.alpha_composite(exported)
    off = np.asarray(paper.convert("RGB")).astype(int) - pixels(tmp_path / "still-0.png")
    assert np.abs(off).max() <= 1  # compositing rounds once more


@FFMPEG
@pytest.mark.parametrize("ending", [".mp4", ".webm"])
def test_films_by_ffmpeg(script, tmp_path, ending):
    film = made(script, tmp_path / f"a{ending}", "--replay", "--brush", *FLIGHT, "--seconds", "1", "--fps", "12")
    words = ["ffmpeg", "-v", "error", "-i", str(film), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    raw = subprocess.run(words, check=True, capture_output=True).stdout
    frames = np.frombuffer(raw, np.uint8).reshape(-1, 48, 64, 3)
    assert len(frames) == 12
    assert frames[0].min() > 245
    assert frames[-1].min() < 100
    assert [path.name for path in tmp_path.iterdir()] == [film.name]


def test_longer_films_have_fewer_frames_where_they_are_bounded(script, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("engine.film.formats.MOST_FRAMES", 6)
    with Image.open(made(script, tmp_path / "a.gif", "--seconds", "2", "--fps", "30")) as film:
        assert film.n_frames <= 6
    told = capsys.readouterr()
    assert (
        told.err
        == f"inkfall: {tmp_path / 'a.gif'}: GIF holds at most 6 frames of this size: 3 a second instead of 30\n"
    )
    assert "6 frames of 64 x 48, 2 s at 3 a second" in told.out


def test_what_is_wrong_is_told_in_a_line(script, saved, tmp_path, capsys, monkeypatch):
    out = tmp_path / "a.webp"
    assert ".mp4" in refused(capsys, "film", script, tmp_path / "a.txt")
    assert "%05d" in refused(capsys, "film", script, tmp_path / "a-%05d.gif")
    assert "even" in refused(capsys, "film", script, tmp_path / "a.mp4", "--size", "33x20")
    assert "--replay" in refused(capsys, "film", script, out, *FLIGHT, "--brush")
    assert "found '0'" in refused(capsys, "film", script, out, "--fps", "0")
    assert "bookmarks (none)" in refused(capsys, "film", script, out, "--flight", "1,2,3")
    assert "expected .ora or .jsonl" in refused(capsys, "film", tmp_path / "a.png", out)
    (tmp_path / "bad.jsonl").write_text(script.read_text() + '{"do": "layer", "remove": "nothing"}\n')
    assert "line 9" in refused(capsys, "film", tmp_path / "bad.jsonl", out)
    monkeypatch.setattr("shutil.which", lambda name: None)
    assert "found no ffmpeg" in refused(capsys, "film", script, tmp_path / "a.mp4", status=1)
    assert [path.name for path in tmp_path.iterdir()] == ["bad.jsonl"]


def test_a_flight_through_bookmarks(script, tmp_path, capsys):
    """From one to the next, each shown as large as the picture allows; a replay reads them from its recording."""
    marked = tmp_path / "b.jsonl"
    marks = ('"far, far", "level": 0, "origin": [0, 0]', '"near", "level": 3, "origin": [200, 160]')
    lines = [f'{{"do": "bookmark", "name": {mark}, "size": [64, 48]}}\n' for mark in marks]
    marked.write_text(script.read_text() + "".join(lines))
    for out, words in (("a", ("all",)), ("b", ("far, far", "near")), ("c", ("0,0,0,64,48", "3,200,160,64,48"))):
        flight = [word for where in words for word in ("--flight", where)]
        made(marked, tmp_path / f"{out}-%d.png", *flight, "--seconds", "2", "--fps", "3")
    made(marked, tmp_path / "d-%d.png", "--flight", "near", "--replay", "--seconds", "2", "--fps", "3")
    for n in range(6):
        assert len({(tmp_path / f"{out}-{n}.png").read_bytes() for out in "abc"}) == 1
    assert (tmp_path / "d-5.png").read_bytes() == (tmp_path / "a-5.png").read_bytes()
    assert (tmp_path / "d-0.png").read_bytes() != (tmp_path / "a-0.png").read_bytes()
    told = refused(capsys, "film", marked, tmp_path / "e.gif", "--flight", "near,nearer")
    assert "found 'near,nearer', expected all, names of bookmarks ('far, far', 'near'), or L,X,Y,W,H" in told


def test_a_painting_without_a_recording_can_only_be_flown_through(saved, tmp_path, capsys):
    main(["export", str(saved), str(tmp_path / "b.ora"), "--layer", "Sky"])
    assert "found no recording" in refused(capsys, "film", tmp_path / "b.ora", tmp_path / "a.webp")
    made(tmp_path / "b.ora", tmp_path / "a.webp", *FLIGHT, "--seconds", "1", "--fps", "2")


@FFMPEG
@pytest.mark.parametrize("name", ["a.mp4", "a-%03d.png"])
def test_nothing_is_left_of_a_film_that_is_given_up(saved, tmp_path, name):
    process = start("film", saved, tmp_path / name, *FLIGHT, "--size", "640x480", "--seconds", "600")
    end = time.monotonic() + 90
    while not list(tmp_path.iterdir()):
        assert process.poll() is None, process.stderr.read()
        assert time.monotonic() < end
        time.sleep(0.05)
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    try:
        told = process.communicate(timeout=90)[1]
    finally:
        process.kill()
    assert (process.returncode, told) == (1, "inkfall: interrupted; nothing half-written is left\n")
    assert list(tmp_path.iterdir()) == []
