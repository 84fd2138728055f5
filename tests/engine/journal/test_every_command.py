"""Every command of the language is journalled when it is asked for and when it is done, and comes back as it was."""

import dataclasses
import typing

import numpy as np
import pytest
from test_answers import idle
from test_recovering import left, painter

from engine.brush.copies import Copy
from engine.brush.settings import Brush
from engine.journal import entries
from engine.journal.heads import head_of_new
from engine.journal.journal import Journal
from engine.journal.records import Kind, read_command, told_command
from engine.journal.story import read_story
from engine.journal.volume import End
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import places, select_commands
from engine.painting.layering.painting_member import NamedNode
from engine.painting.layering.pictures_member import BroughtGroup, BroughtPicture
from engine.studio import requests as q
from engine.studio.filing.recovering import recovered

LINE = np.array([[10.25, 20, 0.5, 1, 2, 0.1], [90, 70 + 1 / 3, 1, 0, 0, 0.2]])
LINE.flags.writeable = False
MORE = c.parse({"do": "undo", "newer": {"than": [1, 2, {"this": 0.1}]}}).extra
# One of each: a command that is not here fails `test_no_command_is_missing`.
SAMPLES = {
    c.Stroke: c.Stroke(
        2, (1 << 70, -3), LINE, Brush(radius=3.5, colour="#102030"), "sky", 7, MORE, (Copy(0.6, -0.8, 3.25, 4.5, True),)
    ),
    c.Fill: c.Fill(
        Brush(colour="#20a0f0"),
        c.Like((9, 9), 1, Rect(-5, 0, 90, 70), 0.25, 6, False, None),
        open=True,
        layer="sky",
        extra=MORE,
        grow=2.5,
    ),
    c.AddLayer: c.AddLayer("cloud", group=None, to=0, extra=MORE),
    c.AddPicture: c.AddPicture("photo", "grit", 1, (5, -6)),
    c.AddPictures: c.AddPictures(
        "scans",
        "grit",
        (BroughtPicture("a", (0, 1, 8, 9), (-3, 4), 0.5, False, "multiply", True), BroughtGroup("b", (), 0.25)),
        -1,
        (1 << 70, 2),
        extra=MORE,
    ),
    c.AddPainting: c.AddPainting("lake", "grit", (NamedNode("a"), NamedNode("b", (NamedNode("d"),))), 2, (16, -32)),
    c.AddPlacement: c.AddPlacement("sky again", c.Placing("sky", (5, -6), turn=1, mirror=True)),
    c.BakePlacement: c.BakePlacement("sky again"),
    c.MergeLayer: c.MergeLayer("sky again"),
    c.SetFrame: c.SetFrame(Rect.at(-3, 4, 500, 400)),
    c.SetPaper: c.SetPaper("#e0d0b0"),
    c.Erode: c.Erode(Rect.at(-9, 1 << 70, 40, 30), 3, "sky", 0.25, 0.75, 0.0, 9, MORE),
    c.LayGround: c.LayGround(
        "grit", Rect.at(-9, 1 << 70, 40, 30), 3, "sky", (-4.5, 60.0), (0, 9.25), 0.5, 0.9, 7.5, 9, MORE
    ),
    c.Touch: c.Touch("agate", ((1.5, -2.0, 300.25, 0.5), (9.0, 8.0, 7.0, 1.0)), Brush(radius=9.5), (1,), MORE),
    c.CleanSolid: c.CleanSolid("agate", MORE),
    c.ClearLayer: c.ClearLayer("sky"),
    c.SelectLayer: c.SelectLayer("sky"),
    c.RemoveLayer: c.RemoveLayer("cloud"),
    c.RenameLayer: c.RenameLayer("sky", "heaven"),
    c.DuplicateLayer: c.DuplicateLayer("sky", "sky 2"),
    c.MoveLayer: c.MoveLayer("sky", 0),
    c.SetLayer: c.SetLayer("sky", opacity=0.25, blend="multiply", wrap=None),
    c.CopyPaint: c.CopyPaint("sky", MORE),
    c.CutPaint: c.CutPaint("sky"),
    c.PastePaint: c.PastePaint("earth"),
    c.Undo: c.Undo(1),
    c.Redo: c.Redo(1),
    c.View: c.View(1.5, (3, 4.5), (800, 600)),
    c.DefineTexture: c.DefineTexture("grit", "rock", c.parse({"do": "undo", "period": 64}).extra),
    c.Select: c.Select(select_commands.Box(0, Rect(2, 3, 40, 50), True), "add", 0, -1.5, 2, "sun", MORE),
    c.Swap: c.Swap(0, (5, 6), "leaves", "sky", 0.5, 2),
    c.FlattenGroup: c.FlattenGroup(None),
    places.Bookmark: places.Bookmark("shore", 3.5, (1.5, 2), (800, 600), 12.0),
    places.RenameBookmark: places.RenameBookmark("shore", "coast"),
    places.RemoveBookmark: places.RemoveBookmark("coast"),
    c.Guide: c.Guide("axis", "symmetry", 3, (1 << 80, -4), ((0.5, 1.25), (30.0, -4.0)), 5, True, True, extra=MORE),
    c.RemoveGuide: c.RemoveGuide("axis"),
}
UNDOABLE = (
    c.Swap,
    c.RenameLayer,
    c.AddPicture,
    c.AddPictures,
    c.AddPainting,
    c.Erode,
    c.LayGround,
)  # which need more than a layer "sky" there


def test_no_command_is_missing():
    """The union of all commands, as the type tells them, and the table that reads them."""
    told = set(typing.get_args(c.Command))
    assert set(SAMPLES) == told == {record for form in c.COMMANDS.values() for record in form.records}


@pytest.mark.parametrize("kind", SAMPLES, ids=lambda kind: kind.__name__)
def test_it_stands_in_the_journal_as_asked_and_as_done(tmp_path, kind):
    command = SAMPLES[kind]
    assert read_command(told_command(command)) == command
    journal = Journal(head_of_new(), tmp_path)
    number = journal.ask(told_command(command))
    journal.note(Kind.DID, told_command(command))
    journal.close(End.STAYS)
    (entry,) = entries.listed(tmp_path) or [None] if kind is not c.View else [None]
    folder = next(tmp_path.iterdir()) if entry is None else entry.folder
    story = read_story(folder)
    assert [command] == story.commands
    assert story.asked[number].command == command
    for field in dataclasses.fields(command):
        held, there = getattr(story.commands[0], field.name), getattr(command, field.name)
        assert np.array_equal(held, there) if isinstance(there, np.ndarray) else held == there


def test_all_are_recovered_in_order(tmp_path):
    """Those that can be carried out here, by a studio, and from its journal."""
    worker = painter(tmp_path)
    worker.post(q.Do(c.AddLayer("sky")))
    for kind in (kind for kind in SAMPLES if kind not in UNDOABLE):
        worker.post(q.Do(dataclasses.replace(SAMPLES[kind])))
    idle(worker)
    left(worker)
    (entry,) = entries.listed(tmp_path)
    found = recovered(entry.folder)
    assert found.missing == []
    done = {type(command) for command in found.session.log}
    assert done == set(SAMPLES) - set(UNDOABLE)
