"""The cards of paintings that can be had back: what is listed, and the words on them."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from engine.journal.entries import Entry

_DAY = 86400  # seconds


@dataclass(slots=True)
class RecoveryState:
    """`cards`: what was not closed, the newest first; `bin`: what lies in the bin, None before that is known;
    `crashed`: the idents of those whose program crashed; `serial`: of the painting that was looked after last."""

    cards: tuple[Entry, ...] = ()
    bin: tuple[Entry, ...] | None = None
    crashed: frozenset[str] = frozenset()
    serial: int = 0


def newest_first(entries: tuple[Entry, ...], wanted: Callable[[Entry], bool]) -> tuple[Entry, ...]:
    """Returns those wanted that are alive in no program."""
    found = [entry for entry in entries if not entry.alive and wanted(entry)]
    return tuple(sorted(found, key=lambda entry: -entry.when))


def crashed_among(entries: tuple[Entry, ...], programs: frozenset[str]) -> frozenset[str]:
    """Returns the idents of the entries that were open last in one of these programs, which crashed."""
    return frozenset(entry.ident for entry in entries if not entry.alive and entry.program in programs)


def when_text(when: float, now: float) -> str:
    """Returns a time, seconds since 1970, as one says it on that day: with the local clock."""
    then, today = time.localtime(when), time.localtime(now)
    clock = time.strftime("%H:%M", then)
    if then[:3] == today[:3]:
        return f"Today, {clock}"
    if then[:3] == time.localtime(now - _DAY)[:3]:
        return f"Yesterday, {clock}"
    year = "" if then.tm_year == today.tm_year else f" {then.tm_year}"
    return f"{then.tm_mday} {time.strftime('%B', then)}{year}, {clock}"


def made_text(strokes: int, seconds: float) -> str:
    """Returns how many strokes there are, and how long it took to make them."""
    count = "1 stroke" if strokes == 1 else f"{strokes:,} strokes"
    return f"{count}, painted in {span_text(seconds)}"


def span_text(seconds: float) -> str:
    """Returns a span of time, as one says it."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 60 else f"{minutes // 60} h {minutes % 60:02d} min"
