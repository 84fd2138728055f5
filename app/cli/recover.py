"""List paintings that were not closed, or were closed without being saved; open and save one, or discard it."""

from __future__ import annotations

import argparse
import json
import sys
import time
from typing import TYPE_CHECKING

from app.cli.outcome import DONE, Failed, Refused
from app.cli.output import checked_output
from app.cli.progress import Progress

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.journal.entries import Entry


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("entry", metavar="ID", nargs="?", help="its short name, or its number in the list")
    parser.add_argument("--save", metavar="P.ora", help="write the painting")
    parser.add_argument("--discard", action="store_true", help="put it into the bin; what is there already is deleted")
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    from engine.journal.entries import discard, listed

    if options.entry is None and (options.save or options.discard):
        raise Refused("found no ID, expected one, or a number of the list: inkfall recover")
    if options.save and options.discard:
        raise Refused("found --save and --discard, expected one of them")
    checked_output(options.save, (".ora",))
    entries = listed()
    if options.entry is None:
        _tell(entries, options.json)
        return DONE
    entry = _chosen(entries, options.entry)
    if options.discard:
        discard(entry)
        _tell((entry,), options.json, "deleted " if entry.in_bin else "in the bin: ")
    elif options.save:
        _save(entry, options)
    else:
        _tell((entry,), options.json)
    return DONE


def _chosen(entries: Sequence[Entry], word: str) -> Entry:
    """Returns the entry of that short name or number."""
    for entry in entries:
        if word in (entry.ident, str(entry.number)):
            return entry
    raise Refused(f"{word}: found no such painting, expected one of the {len(entries)} that inkfall recover lists")


def _save(entry: Entry, options: argparse.Namespace) -> None:
    from engine.archive.saving import Snapshot, save
    from engine.painting.grown import settled
    from engine.studio.filing.recovering import recovered

    if entry.alive:
        raise Failed(f"{entry.ident}: is open in a window: save it there")
    with Progress("recovering", 100) as tell:
        found = recovered(entry.folder, tell.part)
        painting = settled(found.session.painting)
    with Progress("saving", 100) as tell:
        save(options.save, Snapshot(painting, found.session.recording() if found.known else None), tell.part)
    for line in found.missing:
        print(f"inkfall: {entry.ident}: missing: {line}", file=sys.stderr)
    if options.json:
        print(json.dumps({"id": entry.ident, "written": options.save, "missing": found.missing}))
    else:
        print(f"wrote {options.save}")


def _tell(entries: Sequence[Entry], as_json: bool, before: str = "") -> None:
    if as_json:
        print(json.dumps({"paintings": [_facts(entry) for entry in entries]}))
        return
    if not entries:
        print("no painting is left to be recovered")
    for entry in entries:
        when = time.strftime("%Y-%m-%d %H:%M", time.localtime(entry.when))
        marks = [word for word, on in (("open in a window", entry.alive), ("in the bin", entry.in_bin)) if on]
        told = [entry.name, when, f"{entry.strokes} strokes", f"{entry.seconds / 60:.0f} min", *marks, *entry.faults]
        print(f"{before}{entry.number}  {entry.ident}  " + ", ".join(told))


def _facts(entry: Entry) -> dict[str, object]:
    return {
        "number": entry.number,
        "id": entry.ident,
        "name": entry.name,
        "file": None if entry.path is None else str(entry.path),
        "when": entry.when,
        "strokes": entry.strokes,
        "seconds": round(entry.seconds, 1),
        "open": entry.alive,
        "bin": entry.in_bin,
        "damaged": list(entry.faults),
        "folder": str(entry.folder),
    }
