"""What is known of a pointing device: its axes, and where each was last."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(slots=True)
class Axis:
    """What a valuator means, and its range."""

    role: str
    lo: float
    hi: float

    def value(self, raw: float) -> float:
        """Pressure 0..1; tilt and rotation in degrees."""
        if self.role == "pressure":
            return min(1.0, max(0.0, (raw - self.lo) / (self.hi - self.lo))) if self.hi > self.lo else 0.0
        if self.role == "rotation":
            return raw / (self.hi - self.lo + 1.0) * 360.0 if self.hi > self.lo else 0.0
        most = max(abs(self.lo), abs(self.hi))
        degrees = raw if most <= 90 else raw / most * 90
        return min(90.0, max(-90.0, degrees))


@dataclass(slots=True)
class Device:
    """A slave pointer.  Events tell only the axes that changed, so `last` keeps each axis's value."""

    name: str
    axes: dict[int, Axis] = field(default_factory=dict)
    last: dict[str, float] = field(default_factory=dict)
    direct: bool = False  # fingers touch what they see

    @property
    def pen(self) -> bool:
        """Tells whether it feels pressure."""
        return any(axis.role == "pressure" for axis in self.axes.values())

    @property
    def eraser(self) -> bool:
        """Tells whether it is a pen's other end, which only its name says."""
        return "eraser" in self.name.lower()

    @property
    def pad(self) -> bool:
        """Tells whether it is the buttons and rings beside a tablet, which only its name says, too."""
        return self.name.lower().endswith(" pad")

    @property
    def touch(self) -> bool:
        """Tells whether fingers move it: a screen, or a tablet, as its name says; the pad of a laptop is a mouse."""
        return self.direct or self.name.lower().endswith((" finger", " touch"))

    def take(self, values: dict[int, float]) -> None:
        """Raw valuators by number, as an event brings them."""
        for number, raw in values.items():
            axis = self.axes.get(number)
            if axis is not None:
                self.last[axis.role] = axis.value(raw)
