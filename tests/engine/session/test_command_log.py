"""Commands done long ago, on disk as the lines of a recording tell them: whoever asks finds what was done."""

import io

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map

from engine.archive.saving import Snapshot, save
from engine.keeping.spill import Spill
from engine.numeric.recent import Recent
from engine.painting import commands as c
from engine.painting.recording import Header, Recording, read_from
from engine.session.logged import command_log
from engine.session.logged.command_log import CommandLog, Commands
from engine.session.session import Session
from engine.session.steps import Steps

KINDS = (
    lambda n: {"do": "stroke", "origin": [n, 1 << 80], "points": [[n / 3, 0.1, 0.5], [7, n]], "brush": {"radius": 2}},
    lambda n: {"do": "undo", "count": n + 1},
    lambda n: {"do": "layer", "add": f"ä “{n}”"},
    lambda n: {"do": "guide", "name": f"r{n}", "kind": "symmetry", "points": [[0, 0], [n, 9]]},
    lambda n: {"do": "frame", "rect": [0, 0, n + 1, 7]},
)
COMMANDS = st.builds(lambda kind, n: c.parse(kind(n)), st.sampled_from(KINDS), st.integers(0, 50))


@pytest.fixture(scope="module", autouse=True)
def disk(tmp_path_factory):
    """Few commands stay as they are."""
    spill = Spill(tmp_path_factory.mktemp("spill"))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(command_log, "spill", lambda: spill)
        for name, value in (("NEWEST", 2), ("_AS_THEY_ARE", 500), ("_EACH", 3)):
            patch.setattr(command_log, name, value)
        patch.setattr(command_log, "_COMMANDS_READ", Recent(lambda: 1))
        yield spill
    spill.close()


@settings(max_examples=40)
@given(st.lists(COMMANDS, max_size=40), st.integers(0, 40))
def test_a_log_is_a_list_of_its_commands(commands, count):
    log = CommandLog()
    for number, command in enumerate(commands):
        if number == count:
            held = log.now()
        log.append(command)
    assert list(log) == commands
    assert log == commands
    assert [log[n] for n in range(-len(log), len(log))] == commands * 2
    assert log[count:] == commands[count:]
    assert log != [*commands, c.Undo()]
    with pytest.raises(IndexError):
        log[len(log)]
    if count < len(commands):
        assert list(held) == commands[:count]  # what was handed out stays what it was
        again = CommandLog(held)
        for command in commands[count:]:
            again.append(command)
        assert again == log


@settings(max_examples=20)
@given(st.lists(COMMANDS, max_size=30))
def test_a_recording_of_them_is_the_same_file(commands):
    log = CommandLog(commands)
    lines = [*Recording(Header(), log.now()).lines()]
    assert lines == [*Recording(Header(), tuple(commands)).lines()]
    data = "\n".join(lines).encode() + b"\n"
    assert read_from(io.BytesIO(data), "r").commands == tuple(commands)


def test_old_commands_lie_on_disk_and_the_newest_can_be_taken_back(disk):
    before, commands = disk.held, [c.parse(KINDS[0](n)) for n in range(40)]
    log = CommandLog(commands)
    assert isinstance(log.now(), Commands)
    assert disk.held > before
    assert sum(isinstance(one, c.Stroke) for one in log._parts[1]) < 10
    assert log.held < 4000
    assert log[-1] is commands[-1]
    assert log.pop() is commands[-1]
    assert log == commands[:-1]


def test_what_is_shared_of_a_log_does_not_grow_with_it():
    one = CommandLog([c.parse(KINDS[0](n)) for n in range(20)])
    other = CommandLog(one.now())
    one.append(c.Undo())
    assert len(other) == 20
    assert [*other] == [*one[:-1]]


def test_a_long_session_is_saved_and_its_steps_are_told_as_if_all_were_at_hand(tmp_path, monkeypatch):
    session = Session()
    for n in range(24):
        session.do(c.parse({"do": "stroke", "origin": [n, 0], "points": [[1, 2], [3, n]], "brush": {"radius": 1.5}}))
    commands = tuple(session.log)
    assert isinstance(session.recording().commands, Commands)
    assert [step.command for step in session.steps.done] == [*commands]
    assert [step.command for step in Steps(session.base, commands).done] == [*commands]
    save(tmp_path / "packed.ora", Snapshot(session.painting, session.recording()))
    save(tmp_path / "plain.ora", Snapshot(session.painting, Recording(session.recording().header, commands)))
    assert (tmp_path / "packed.ora").read_bytes() == (tmp_path / "plain.ora").read_bytes()


def test_strokes_that_say_nothing_else_share_that():
    session = Session()
    for n in range(2):
        live = session.begin(0, (n, 0), c.parse(KINDS[0](0)).brush)
        live.add(np.ones((2, 6)))
        session.finish(live)
    first, second = session.log
    assert first.extra == Map()
    assert first.extra is second.extra
