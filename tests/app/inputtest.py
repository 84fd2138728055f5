"""A pen that a test holds: the client of Xorg's `inputtest` driver (man 4 inputtestdrv).

The driver's messages are C structures on a unix socket: length and type, then the event; a set of valuators is a
flag, a mask of 64 bits and two arrays of 64 doubles, aligned to 8 bytes.
"""

import socket
import struct
import time
from pathlib import Path

VERSION, SYNC, MOTION, PROXIMITY, BUTTON = range(5)
X, Y, PRESSURE = 0, 1, 4
CONFIG = """
Section "ServerFlags"
    Option "AutoAddDevices" "false"
    Option "AutoAddGPU" "false"
EndSection
Section "Device"
    Identifier "card"
    Driver "dummy"
    VideoRam 32768
EndSection
Section "Monitor"
    Identifier "monitor"
    HorizSync 5-1000
    VertRefresh 5-200
    Modeline "1280x800" 83.50 1280 1352 1480 1680 800 803 809 831
EndSection
Section "Screen"
    Identifier "screen"
    Device "card"
    Monitor "monitor"
    DefaultDepth 24
    SubSection "Display"
        Depth 24
        Modes "1280x800"
        Virtual 1280 800
    EndSubSection
EndSection
Section "InputDevice"
    Identifier "Test Pen"
    Driver "inputtest"
    Option "SocketPath" "{socket}"
    Option "DeviceType" "PointerAbsoluteProximity"
    Option "PointerHasPressure" "true"
EndSection
Section "ServerLayout"
    Identifier "layout"
    Screen "screen"
    InputDevice "Test Pen" "SendCoreEvents"
EndSection
"""


class Pen:
    """Moves, presses and lifts.  Keep it until the server ends: without its client the driver spins."""

    def __init__(self, path: Path) -> None:
        self._socket = socket.socket(socket.AF_UNIX)
        end = time.monotonic() + 90
        while not path.exists():
            assert time.monotonic() < end, "the driver made no socket"
            time.sleep(0.05)
        self._socket.settimeout(10)
        self._socket.connect(str(path))
        self._send(VERSION, struct.pack("=HH", 1, 0))
        self._socket.recv(64)

    def _send(self, kind: int, body: bytes) -> None:
        self._socket.sendall(struct.pack("=II", 8 + len(body), kind) + body)

    @staticmethod
    def _valuators(values: dict[int, float]) -> bytes:
        mask = bytearray(8)
        numbers = [0.0] * 64
        for axis, value in values.items():
            mask[axis >> 3] |= 1 << (axis & 7)
            numbers[axis] = value
        return struct.pack("=I8s4x64d", 0, bytes(mask), *numbers) + bytes(512)

    def move(self, x: float, y: float, pressure: float) -> None:
        """To (x, y) in the device's units, with a raw pressure."""
        values = self._valuators({X: x, Y: y, PRESSURE: pressure})
        self._send(MOTION, struct.pack("=I4x", 1) + values)

    def press(self, down: bool) -> None:
        self._send(BUTTON, struct.pack("=iiI4x", 1, 1, int(down)) + self._valuators({}))

    def near(self, near: bool) -> None:
        self._send(PROXIMITY, struct.pack("=I4x", int(near)) + self._valuators({}))

    def sync(self) -> None:
        """Waits until the server has taken in everything."""
        self._send(SYNC, b"")
        self._socket.recv(64)

    def close(self) -> None:
        self._socket.close()
