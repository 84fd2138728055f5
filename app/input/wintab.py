"""Pens on Windows by Wintab: the tablet's own driver, for tablets that Windows Ink serves badly.

Untested: written from Wacom's documentation of Wintab 1.4 (wintab.h, pktdef.h), never run.
"""

from __future__ import annotations

import ctypes as ct
import math
import time
from collections.abc import Callable
from typing import NamedTuple

from app.input.events import LEFT, MIDDLE, RIGHT, PenEvent
from app.input.pen_queue import PenQueue

_DEFAULT_SYSTEM, _DEVICES, _NAME, _PRESSURE, _ORIENTATION = 4, 100, 1, 15, 17  # WTI_..., DVC_...
_MESSAGES = 0x4  # CXO_MESSAGES: each packet wakes the window
_STATUS, _TIME, _CURSOR, _BUTTONS, _X, _Y = 0x2, 0x4, 0x20, 0x40, 0x80, 0x100  # PK_...
_NORMAL_PRESSURE, _TURNED = 0x400, 0x1000
_WANTED = _STATUS | _TIME | _CURSOR | _BUTTONS | _X | _Y | _NORMAL_PRESSURE | _TURNED
_PROXIMITY, _INVERTED = 0x1, 0x10  # TPS_...: the pen has left; it is held the other way round
PARTS_OF_PIXEL = 16  # of a pixel of the screen: what places are told in
_AT_ONCE, _QUEUED = 128, 256  # packets
_NEAR = 0.25  # seconds after a packet in which the mouse is the pen
_PRESSED = ((0x1, LEFT), (0x2, RIGHT), (0x4, MIDDLE))


class _Context(ct.Structure):
    """LOGCONTEXTW."""

    _fields_ = (
        ("lcName", ct.c_wchar * 40),
        *[(name, ct.c_uint32) for name in ("lcOptions", "lcStatus", "lcLocks", "lcMsgBase", "lcDevice", "lcPktRate")],
        *[(name, ct.c_uint32) for name in ("lcPktData", "lcPktMode", "lcMoveMask", "lcBtnDnMask", "lcBtnUpMask")],
        *[(f"lcIn{part}{axis}", ct.c_int32) for part in ("Org", "Ext") for axis in "XYZ"],
        *[(f"lcOut{part}{axis}", ct.c_int32) for part in ("Org", "Ext") for axis in "XYZ"],
        *[(f"lcSens{axis}", ct.c_uint32) for axis in "XYZ"],
        ("lcSysMode", ct.c_int32),
        *[(f"lcSys{part}{axis}", ct.c_int32) for part in ("Org", "Ext") for axis in "XY"],
        *[(f"lcSysSens{axis}", ct.c_uint32) for axis in "XY"],
    )


class _AxisInfo(ct.Structure):
    """AXIS."""

    _fields_ = (("axMin", ct.c_int32), ("axMax", ct.c_int32), ("axUnits", ct.c_uint32), ("axResolution", ct.c_uint32))


class Packet(ct.Structure):
    """PACKET, of the members that are asked for."""

    _fields_ = (
        ("status", ct.c_uint32),
        ("time", ct.c_uint32),
        ("cursor", ct.c_uint32),
        ("buttons", ct.c_uint32),
        ("x", ct.c_int32),
        ("y", ct.c_int32),
        ("pressure", ct.c_uint32),
        ("azimuth", ct.c_int32),
        ("altitude", ct.c_int32),
        ("twist", ct.c_int32),
    )


class _Place(ct.Structure):
    _fields_ = (("x", ct.c_long), ("y", ct.c_long))


class Told(NamedTuple):
    """What the driver tells of a tablet: the highest pressure, and whether it feels how a pen leans, and is turned."""

    heaviest: int
    leans: bool
    turns: bool


def packet_events(packet: Packet, before: int, told: Told, corner: tuple[float, float]) -> list[PenEvent]:
    """Returns a packet as events: a motion, or buttons that are down or up other than `before`; `corner`: of the
    window's client area on the screen, pixels."""
    tilt_x, tilt_y = leaning(packet.azimuth, packet.altitude) if told.leans else (0.0, 0.0)

    def event(kind: str, button: int = 0) -> PenEvent:
        return PenEvent(
            kind,
            packet.x / PARTS_OF_PIXEL - corner[0],
            packet.y / PARTS_OF_PIXEL - corner[1],
            pressure=min(1.0, packet.pressure / max(told.heaviest, 1)),
            tilt_x=tilt_x,
            tilt_y=tilt_y,
            rotation=packet.twist / 10 % 360 if told.turns else None,
            time=packet.time / 1000,
            button=button,
            eraser=bool(packet.status & _INVERTED),
            pen=True,
        )

    if packet.status & _PROXIMITY:
        return [event("lost")] if before else []
    changed = [(bit, button) for bit, button in _PRESSED if (packet.buttons ^ before) & bit]
    return [event("down" if packet.buttons & bit else "up", button) for bit, button in changed] or [event("move")]


def leaning(azimuth: int, altitude: int) -> tuple[float, float]:
    """Returns the tilt to the right and towards the hand, degrees, of tenths of degrees: the azimuth clockwise from
    the upper edge, the altitude over the tablet."""
    up, around = math.radians(min(900, abs(altitude)) / 10), math.radians(azimuth / 10)
    flat = math.cos(up)
    return (
        math.degrees(math.atan2(math.sin(around) * flat, math.sin(up))),
        math.degrees(math.atan2(-math.cos(around) * flat, math.sin(up))),
    )


class WintabPointer(PenQueue):
    """A context of the window's own; its packets are taken each time events are asked for.  OSError where there is no
    driver."""

    name = "pen (Wintab)"

    def __init__(self, window: int, wake: Callable[[], None]) -> None:
        super().__init__(wake)
        self._tab: ct.CDLL = ct.WinDLL("wintab32")  # type: ignore[attr-defined]
        self._user: ct.CDLL = ct.WinDLL("user32")  # type: ignore[attr-defined]
        self._tab.WTOpenW.restype = ct.c_void_p
        self._tab.WTOpenW.argtypes = (ct.c_void_p, ct.POINTER(_Context), ct.c_int)
        self._tab.WTPacketsGet.argtypes = (ct.c_void_p, ct.c_int, ct.c_void_p)
        self._tab.WTQueueSizeSet.argtypes = (ct.c_void_p, ct.c_int)
        self._tab.WTClose.argtypes = (ct.c_void_p,)
        self._user.ClientToScreen.argtypes = (ct.c_void_p, ct.POINTER(_Place))
        self._window, self._buttons, self._last = window, 0, 0.0
        self._told, self._title = self._of_tablet()
        self._context = self._opened()

    def _of_tablet(self) -> tuple[Told, str]:
        pressure, ways, name = _AxisInfo(), (_AxisInfo * 3)(), ct.create_unicode_buffer(256)
        self._tab.WTInfoW(_DEVICES, _PRESSURE, ct.byref(pressure))
        self._tab.WTInfoW(_DEVICES, _ORIENTATION, ct.byref(ways))
        self._tab.WTInfoW(_DEVICES, _NAME, name)
        leans, turns = bool(ways[0].axResolution and ways[1].axResolution), bool(ways[2].axResolution)
        return Told(pressure.axMax, leans, turns), name.value.strip()

    def _opened(self) -> int:
        wanted = _Context()
        if not self._tab.WTInfoW(_DEFAULT_SYSTEM, 0, ct.byref(wanted)):
            raise OSError("Wintab knows no tablet")
        wanted.lcOptions |= _MESSAGES
        wanted.lcPktData = wanted.lcMoveMask = _WANTED
        wanted.lcPktMode, wanted.lcBtnUpMask = 0, wanted.lcBtnDnMask
        wanted.lcOutOrgX, wanted.lcOutOrgY = PARTS_OF_PIXEL * wanted.lcSysOrgX, PARTS_OF_PIXEL * wanted.lcSysOrgY
        wanted.lcOutExtX, wanted.lcOutExtY = PARTS_OF_PIXEL * wanted.lcSysExtX, -PARTS_OF_PIXEL * wanted.lcSysExtY
        context = self._tab.WTOpenW(self._window, ct.byref(wanted), True)
        if not context:
            raise OSError("Wintab opens no context")
        self._tab.WTQueueSizeSet(context, _QUEUED)
        return int(context)

    @property
    def near(self) -> bool:  # type: ignore[override]
        """Tells whether a pen was heard just now."""
        return time.monotonic() - self._last < _NEAR

    def events(self) -> list[PenEvent]:
        """Gives what came since the last call, in order."""
        packets, corner = (Packet * _AT_ONCE)(), _Place()
        self._user.ClientToScreen(self._window, ct.byref(corner))
        while count := self._tab.WTPacketsGet(self._context, _AT_ONCE, packets):
            for packet in packets[:count]:
                self.hear(*packet_events(packet, self._buttons, self._told, (corner.x, corner.y)))
                self._buttons = 0 if packet.status & _PROXIMITY else packet.buttons
            self._last = time.monotonic()
        return super().events()

    def tablets(self) -> list[str]:
        """Returns the tablet's name."""
        return [self._title or self.name]

    def close(self) -> None:
        """Gives the context back."""
        self._tab.WTClose(self._context)
