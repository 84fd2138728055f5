"""Pens and mice on X11 through XInput 2: sub-pixel places, pressure, tilt, in one ordered stream.

GLFW knows no pens.  This opens a connection of its own to the X server and selects the master pointers' events on
GLFW's window; GLFW's own pointer callbacks then fall silent for it.  A thread waits on that connection; whoever asks
for events reads there, too, so that none is missed that came before.
Protocol: "X Input Extension 2.x" (X.Org), structures as in XInput2.h.
"""

from __future__ import annotations

import ctypes as ct
import os
import select
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import replace

from app.input.devices import Axis, Device
from app.input.events import BACK, FORWARD, LEFT, MIDDLE, PAD, RIGHT, PenEvent

ALL_DEVICES, ALL_MASTERS = 0, 1
DEVICE_CHANGED, BUTTON_PRESS, BUTTON_RELEASE, MOTION, HIERARCHY_CHANGED = 1, 4, 5, 6, 11
GENERIC_EVENT = 35
VALUATOR_CLASS, TOUCH_CLASS = 2, 8
DIRECT_TOUCH = 1
FLOATING_SLAVE, MASTER_POINTER, SLAVE_POINTER = 5, 1, 3
_BUTTONS = {1: LEFT, 2: MIDDLE, 3: RIGHT, 8: BACK, 9: FORWARD, **{i: i - 4 for i in range(10, 33)}}
_WHEEL = {4: (0.0, 1.0), 5: (0.0, -1.0), 6: (1.0, 0.0), 7: (-1.0, 0.0)}
_PATIENCE = 0.05  # seconds that whoever asks for events waits for the thread that reads them
_ROLES = {"Abs Pressure": "pressure", "Abs Tilt X": "tilt_x", "Abs Tilt Y": "tilt_y"}
_ROLES |= dict.fromkeys(("Abs Wheel", "Abs Rotary Z"), "rotation")  # the barrel's: of Wacom's driver, of libinput's


class EventMask(ct.Structure):
    """XIEventMask of XInput2.h."""

    _fields_ = (("deviceid", ct.c_int), ("mask_len", ct.c_int), ("mask", ct.POINTER(ct.c_ubyte)))


# What every event of the extension begins with.
_HEADER = (
    ("type", ct.c_int),
    ("serial", ct.c_ulong),
    ("send_event", ct.c_int),
    ("display", ct.c_void_p),
    ("extension", ct.c_int),
    ("evtype", ct.c_int),
)


class Cookie(ct.Structure):
    """XGenericEventCookie."""

    _fields_ = (*_HEADER, ("cookie", ct.c_uint), ("data", ct.c_void_p))


class Event(ct.Union):
    """XEvent: 24 longs."""

    _fields_ = (("type", ct.c_int), ("xcookie", Cookie), ("pad", ct.c_long * 24))


class ButtonState(ct.Structure):
    """XIButtonState of XInput2.h."""

    _fields_ = (("mask_len", ct.c_int), ("mask", ct.POINTER(ct.c_ubyte)))


class ValuatorState(ct.Structure):
    """XIValuatorState of XInput2.h."""

    _fields_ = (("mask_len", ct.c_int), ("mask", ct.POINTER(ct.c_ubyte)), ("values", ct.POINTER(ct.c_double)))


class DeviceEvent(ct.Structure):
    """XIDeviceEvent, up to the valuators."""

    _fields_ = (
        *_HEADER,
        ("time", ct.c_ulong),
        ("deviceid", ct.c_int),
        ("sourceid", ct.c_int),
        ("detail", ct.c_int),
        ("root", ct.c_ulong),
        ("event", ct.c_ulong),
        ("child", ct.c_ulong),
        ("root_x", ct.c_double),
        ("root_y", ct.c_double),
        ("event_x", ct.c_double),
        ("event_y", ct.c_double),
        ("flags", ct.c_int),
        ("buttons", ButtonState),
        ("valuators", ValuatorState),
    )


class AnyClass(ct.Structure):
    """XIAnyClassInfo of XInput2.h."""

    _fields_ = (("type", ct.c_int), ("sourceid", ct.c_int))


class ValuatorClass(ct.Structure):
    """XIValuatorClassInfo of XInput2.h."""

    _fields_ = (
        ("type", ct.c_int),
        ("sourceid", ct.c_int),
        ("number", ct.c_int),
        ("label", ct.c_ulong),
        ("min", ct.c_double),
        ("max", ct.c_double),
        ("value", ct.c_double),
        ("resolution", ct.c_int),
        ("mode", ct.c_int),
    )


class TouchClass(ct.Structure):
    """XITouchClassInfo of XInput2.h."""

    _fields_ = (("type", ct.c_int), ("sourceid", ct.c_int), ("mode", ct.c_int), ("num_touches", ct.c_int))


class DeviceInfo(ct.Structure):
    """XIDeviceInfo of XInput2.h."""

    _fields_ = (
        ("deviceid", ct.c_int),
        ("name", ct.c_char_p),
        ("use", ct.c_int),
        ("attachment", ct.c_int),
        ("enabled", ct.c_int),
        ("num_classes", ct.c_int),
        ("classes", ct.POINTER(ct.POINTER(AnyClass))),
    )


def unpacked(state: ValuatorState) -> dict[int, float]:
    """Returns the valuators of an event: a mask of numbers, then one value for each bit that is set."""
    out: dict[int, float] = {}
    k = 0
    for number in range(state.mask_len * 8):
        if state.mask[number >> 3] & (1 << (number & 7)):
            out[number] = state.values[k]
            k += 1
    return out


def pen_event(event: DeviceEvent, device: Device | None) -> PenEvent | None:
    """Returns the record of an XI_Motion, XI_ButtonPress or XI_ButtonRelease; None for what means nothing here."""
    kind, detail = event.evtype, event.detail
    fields: dict[str, float | int | bool | None] = {}
    if device is not None and device.pen:
        device.take(unpacked(event.valuators))
        fields = {
            "pressure": device.last.get("pressure", 0.0),
            **{name: device.last.get(name, 0.0) for name in ("tilt_x", "tilt_y")},
            "rotation": device.last.get("rotation"),
            "eraser": device.eraser,
            "pen": True,
        }
    elif device is not None and device.touch:
        fields = {"touch": True}
    word = {MOTION: "move", BUTTON_PRESS: "down", BUTTON_RELEASE: "up"}.get(kind)
    if word is None:
        return None
    if kind != MOTION:
        if detail in _WHEEL:
            if kind == BUTTON_RELEASE:
                return None
            word, (fields["dx"], fields["dy"]) = "wheel", _WHEEL[detail]
            fields["pad"] = device is not None and device.pad
        elif device is not None and device.pad:
            fields["button"] = PAD + detail
        elif detail in _BUTTONS:
            fields["button"] = _BUTTONS[detail]
        else:
            return None
    return PenEvent(word, event.event_x, event.event_y, time=event.time / 1000.0, **fields)  # type: ignore[arg-type]


def mask_of(*kinds: int) -> ct.Array[ct.c_ubyte]:
    """Returns the bit mask that XISelectEvents takes."""
    mask = (ct.c_ubyte * 4)()
    for kind in kinds:
        mask[kind >> 3] |= 1 << (kind & 7)
    return mask


class Libraries:
    """libX11 and libXi with the signatures used here; OSError where they are missing."""

    def __init__(self) -> None:
        self.x, self.xi = ct.CDLL("libX11.so.6"), ct.CDLL("libXi.so.6")
        p, i, u = ct.c_void_p, ct.c_int, ct.c_ulong
        for lib, name, result, arguments in (
            (self.x, "XOpenDisplay", p, (ct.c_char_p,)),
            (self.x, "XCloseDisplay", i, (p,)),
            (self.x, "XConnectionNumber", i, (p,)),
            (self.x, "XPending", i, (p,)),
            (self.x, "XNextEvent", i, (p, ct.POINTER(Event))),
            (self.x, "XGetEventData", i, (p, ct.POINTER(Cookie))),
            (self.x, "XFreeEventData", None, (p, ct.POINTER(Cookie))),
            (self.x, "XFlush", i, (p,)),
            (self.x, "XFree", i, (p,)),
            (self.x, "XGetAtomName", p, (p, u)),
            (self.x, "XQueryExtension", i, (p, ct.c_char_p, *[ct.POINTER(i)] * 3)),
            (self.xi, "XIQueryVersion", i, (p, ct.POINTER(i), ct.POINTER(i))),
            (self.xi, "XISelectEvents", i, (p, u, ct.POINTER(EventMask), i)),
            (self.xi, "XIQueryDevice", ct.POINTER(DeviceInfo), (p, i, ct.POINTER(i))),
            (self.xi, "XIFreeDeviceInfo", None, (ct.POINTER(DeviceInfo),)),
        ):
            function = getattr(lib, name)
            function.restype, function.argtypes = result, arguments


class Unavailable(RuntimeError):
    """XInput 2 cannot be used here; the mouse still works through GLFW."""


class XInput2Pointer:
    """The stream of a window.  `wake` is called from the waiting thread when events have come."""

    name = "pen and mouse (XInput 2)"
    near = False

    def __init__(self, window: int, wake: Callable[[], None], display: str | None = None) -> None:
        try:
            self._lib = Libraries()
        except OSError as error:
            raise Unavailable(str(error)) from None
        self._display = self._lib.x.XOpenDisplay(display.encode() if display else None)
        if not self._display:
            raise Unavailable("the X server refuses a second connection")
        self._extension = self._check()
        self._wake = wake
        self._queue: deque[PenEvent] = deque()
        self._reading = threading.Lock()  # whoever has it uses the connection
        self._devices = self._query()
        self._held: dict[int, PenEvent] = {}  # by the ids of devices that are pressed, what came last of each
        self._select(window)
        self._quit_read, self._quit_write = os.pipe()
        self._thread = threading.Thread(target=self._run, name="inkfall pointer", daemon=True)
        self._thread.start()

    def _check(self) -> int:
        lib, opcode, event, error = self._lib, ct.c_int(), ct.c_int(), ct.c_int()
        found = lib.x.XQueryExtension(self._display, b"XInputExtension", opcode, event, error)
        major, minor = ct.c_int(2), ct.c_int(2)
        if not found or lib.xi.XIQueryVersion(self._display, major, minor) != 0:
            lib.x.XCloseDisplay(self._display)
            raise Unavailable("the X server has no XInput 2")
        return opcode.value

    def _select(self, window: int) -> None:
        mask = mask_of(MOTION, BUTTON_PRESS, BUTTON_RELEASE, DEVICE_CHANGED)
        wanted = EventMask(ALL_MASTERS, len(mask), ct.cast(mask, ct.POINTER(ct.c_ubyte)))
        self._lib.xi.XISelectEvents(self._display, window, wanted, 1)
        changes = mask_of(HIERARCHY_CHANGED)
        wanted = EventMask(ALL_DEVICES, len(changes), ct.cast(changes, ct.POINTER(ct.c_ubyte)))
        self._lib.xi.XISelectEvents(self._display, window, wanted, 1)
        self._lib.x.XFlush(self._display)

    def _query(self) -> dict[int, Device]:
        """Returns the slave pointers that are there, by their ids."""
        count = ct.c_int()
        infos = self._lib.xi.XIQueryDevice(self._display, ALL_DEVICES, count)
        out = {}
        for i in range(count.value):
            info = infos[i]
            if info.enabled and info.use in (SLAVE_POINTER, FLOATING_SLAVE):
                out[info.deviceid] = self._device(info)
        self._lib.xi.XIFreeDeviceInfo(infos)
        return out

    def _device(self, info: DeviceInfo) -> Device:
        device = Device((info.name or b"").decode("utf-8", "replace"))
        for j in range(info.num_classes):
            if info.classes[j].contents.type == TOUCH_CLASS:
                touch = ct.cast(info.classes[j], ct.POINTER(TouchClass)).contents
                device.direct = touch.mode == DIRECT_TOUCH
            if info.classes[j].contents.type != VALUATOR_CLASS:
                continue
            axis = ct.cast(info.classes[j], ct.POINTER(ValuatorClass)).contents
            role = _ROLES.get(self._atom(axis.label))
            if role is not None:
                device.axes[axis.number] = Axis(role, axis.min, axis.max)
                device.last[role] = device.axes[axis.number].value(axis.value)
        return device

    def _atom(self, atom: int) -> str:
        name = self._lib.x.XGetAtomName(self._display, atom) if atom else None
        if not name:
            return ""
        text = ct.string_at(name).decode("utf-8", "replace")
        self._lib.x.XFree(name)
        return text

    def _run(self) -> None:
        descriptor = self._lib.x.XConnectionNumber(self._display)
        while True:
            if not self._read():
                ready, _, _ = select.select([descriptor, self._quit_read], [], [])
                if self._quit_read in ready:
                    break
                continue
            self._wake()
        self._lib.x.XCloseDisplay(self._display)

    def _read(self, seconds: float = -1) -> bool:
        """Takes in what has come; whether there was anything.  `seconds`: how long it waits for another thread that
        reads, which never ends where the X server is gone; as long as it takes, unless told."""
        event, found = Event(), False
        if not self._reading.acquire(timeout=seconds):
            return False
        try:
            while self._lib.x.XPending(self._display):
                self._lib.x.XNextEvent(self._display, event)
                self._handle(event)
                found = True
        finally:
            self._reading.release()
        return found

    def _handle(self, event: Event) -> None:
        cookie = event.xcookie
        if event.type != GENERIC_EVENT or cookie.extension != self._extension:
            return
        if not self._lib.x.XGetEventData(self._display, cookie):
            return
        if cookie.evtype in (MOTION, BUTTON_PRESS, BUTTON_RELEASE):
            report = ct.cast(cookie.data, ct.POINTER(DeviceEvent)).contents
            found = pen_event(report, self._devices.get(report.sourceid))
            if found is not None:
                self._queue.append(found)
                self._hold(report.sourceid, found)
        else:
            self._devices = self._query()
            self._miss()
        self._lib.x.XFreeEventData(self._display, cookie)

    def _hold(self, device: int, event: PenEvent) -> None:
        if event.kind == "down" or (event.kind == "move" and device in self._held):
            self._held[device] = event
        elif event.kind == "up":
            self._held.pop(device, None)

    def _miss(self) -> None:
        """Tells of devices that were pressed and are gone."""
        for device in self._held.keys() - self._devices.keys():
            self._queue.append(replace(self._held.pop(device), kind="lost"))

    def events(self) -> list[PenEvent]:
        """Gives what came since the last call, in order."""
        out = []
        self._read(_PATIENCE)
        while self._queue:
            out.append(self._queue.popleft())
        return out

    def tablets(self) -> list[str]:
        """Returns the names of the pens that are there, each once."""
        return list(dict.fromkeys(device.name for device in self._devices.values() if device.pen))

    def close(self) -> None:
        """Ends the thread, which closes the connection; before the window is destroyed."""
        os.write(self._quit_write, b"x")
        self._thread.join(2.0)
        os.close(self._quit_read)
        os.close(self._quit_write)
