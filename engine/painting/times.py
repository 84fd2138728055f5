"""When a command was asked for: its member `time`, seconds since 1970.

It changes no pixel.  Readers that do not know it keep it among the members that they do not know.
"""

from __future__ import annotations

from dataclasses import replace

from immutables import Map

from engine.painting.commands import Command, DefineTexture

_MEMBER = "time"
_YEAR_10000 = 253402300800  # the first second that no calendar here has


def members(time: float | None) -> Map[str, object]:
    """Returns what such a command has of its own besides: the time, if there is one."""
    return Map() if time is None else Map({_MEMBER: time})


def timed(command: Command, time: float | None) -> Command:
    """Returns a command with the time when it was asked for; the same one if that is None or it has a time already."""
    if time is None or _MEMBER in _given(command):
        return command
    if isinstance(command, DefineTexture):
        return replace(command, arguments=command.arguments.set(_MEMBER, time))
    return replace(command, extra=command.extra.set(_MEMBER, time))


def _given(command: Command) -> Map[str, object]:
    return command.arguments if isinstance(command, DefineTexture) else command.extra


def time_of(command: Command) -> float | None:
    """Returns the time of a command, seconds since 1970; None where it has none, or what it has is no time."""
    time = _given(command).get(_MEMBER)
    if not isinstance(time, int | float) or isinstance(time, bool) or not 0 <= time < _YEAR_10000:
        return None
    return float(time)


def untimed(command: DefineTexture) -> DefineTexture:
    """Returns a definition without its time: that is no parameter of the texture."""
    given = command.arguments
    return replace(command, arguments=given.delete(_MEMBER)) if _MEMBER in given else command
