"""Frames: what was written comes back, and whatever is torn or flipped gives the longest beginning that is whole."""

import random
import struct
import zlib

import pytest
from headless import strokes

from engine.journal import entries
from engine.journal.frames import PREFIX_BYTES, Frame, framed, frames_in
from engine.journal.heads import head_of_new
from engine.journal.journal import Journal
from engine.journal.records import told_command
from engine.journal.story import read_story
from engine.journal.volume import End
from engine.painting import commands as c

PROTOTYPE = struct.Struct("<2sBBIQI")


def some(bytes_in_all, seed=1):
    """Frames of many sizes, and their bytes."""
    told, frames, data = random.Random(seed), [], b""
    while len(data) < bytes_in_all:
        payload = told.randbytes(told.choice((0, 1, 7, 48, 300, 2400)))
        frames.append(Frame(len(frames), told.randrange(1, 13), payload))
        data += framed(frames[-1])
    return frames, data


def ends(frames):
    """Where each frame ends."""
    at, found = 0, [0]
    for frame in frames:
        at += PREFIX_BYTES + len(frame.payload)
        found.append(at)
    return found


def test_what_was_framed_is_read():
    frames, data = some(64 << 10)
    assert frames_in(data) == (frames, len(data))


def test_cut_at_every_byte_the_longest_whole_beginning_is_read():
    """Every cut is looked at: as far as the last whole frame, and never an exception."""
    frames, data = some(64 << 10)
    whole = ends(frames)
    count = 0
    for cut in range(len(data)):
        count += cut >= whole[count + 1]
        start = max(0, count - 2)  # what lies before is the same for all cuts of a frame
        found, good = frames_in(data[whole[start] : cut])
        assert (found, good) == (frames[start:count], whole[count] - whole[start])


def test_each_byte_flipped_ends_what_is_read_at_its_frame():
    frames, data = some(64 << 10)
    whole, held = ends(frames), bytearray(data)
    at = 0
    for place in range(len(data)):
        at += place >= whole[at + 1]
        held[place] ^= 1 << (place % 8)
        found, good = frames_in(bytes(held[whole[at] : whole[at] + 8000]))
        assert (found, good) == ([], 0)
        held[place] = data[place]
    for place in random.Random(2).sample(range(len(data)), 60):
        held[place] ^= 0xFF
        at = sum(end <= place for end in whole) - 1
        assert frames_in(bytes(held)) == (frames[:at], whole[at])
        held[place] = data[place]


def test_zeros_rubbish_and_frames_out_of_order_end_it():
    frames, data = some(2000)
    for tail in (bytes(5000), random.Random(3).randbytes(5000), framed(Frame(len(frames) + 1, 3, b"later"))):
        assert frames_in(data + tail) == (frames, len(data))


def test_it_agrees_with_the_form_that_was_tried_first():
    """The same payloads in the prototype's frames, torn at the same payload: both read as many."""
    frames, _ = some(4000)
    theirs = b""
    for frame in frames:
        head = PROTOTYPE.pack(b"SJ", 2, 0, len(frame.payload), frame.sequence + 1, 0)
        total = zlib.crc32(head + frame.payload)
        theirs += PROTOTYPE.pack(b"SJ", 2, 0, len(frame.payload), frame.sequence + 1, total) + frame.payload
    for keep in range(len(frames)):
        ours = b"".join(map(framed, frames))[: ends(frames)[keep + 1] - 1]
        cut = theirs[: sum(PROTOTYPE.size + len(frame.payload) for frame in frames[: keep + 1]) - 1]
        assert len(frames_in(ours)[0]) == prototype_count(cut) == keep


def prototype_count(data):
    """How many frames the prototype reads."""
    at = count = 0
    while at + PROTOTYPE.size <= len(data):
        mark, kind, _, length, sequence, total = PROTOTYPE.unpack_from(data, at)
        end = at + PROTOTYPE.size + length
        if mark != b"SJ" or sequence != count + 1 or end > len(data):
            break
        if zlib.crc32(PROTOTYPE.pack(mark, kind, 0, length, sequence, 0) + data[at + PROTOTYPE.size : end]) != total:
            break
        at, count = end, count + 1
    return count


def painted(folder, size):
    """The journal's file of an entry with about so many bytes of strokes, and all that was asked for."""
    journal, asked = Journal(head_of_new(), folder), []
    for brush, points, _ in strokes(4):
        if 48 * sum(len(stroke.points) for stroke in asked) > size:
            break
        points.flags.writeable = False
        asked.append(c.Stroke(0, (0, 0), points, brush))
        journal.ask(told_command(asked[-1]))
    journal.close(End.STAYS)
    (entry,) = entries.listed(folder)
    return entry.folder / "journal-1", asked


@pytest.mark.parametrize("every", [977, pytest.param(7, marks=pytest.mark.nightly)])
def test_cut_or_flipped_anywhere_a_journal_gives_its_longest_whole_beginning(tmp_path, every):
    """And its entry is listed, whatever is wrong with it."""
    path, asked = painted(tmp_path, 64 << 10)
    data = path.read_bytes()
    frames, good = frames_in(data)
    assert good == len(data) > 64 << 10
    whole = ends(frames)
    for place in range(0, len(data), every):
        flipped = bytearray(data)
        flipped[place] ^= 1 << (place % 8)
        count = max(0, sum(end <= place for end in whole) - 2)  # the head is none that was asked for
        for bad in (data[:place], bytes(flipped)):
            path.write_bytes(bad)
            found = [one.command for one in read_story(path.parent).asked.values()]
            assert found == asked[:count]
        if place % (50 * every) == 0:
            (entry,) = entries.listed(tmp_path) or [None]
            assert entry is not None
            assert entry.faults
    path.write_bytes(data)
    about = path.with_name(entries.ABOUT_FILE)
    told = about.read_bytes()
    for place in range(len(told)):
        for bad in (told[:place], told[:place] + bytes([told[place] ^ 4]) + told[place + 1 :]):
            about.write_bytes(bad)
            (entry,) = entries.listed(tmp_path)
            assert entry.strokes == len(asked)
