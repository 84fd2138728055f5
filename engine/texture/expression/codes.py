"""What the machine of written textures can do to rows of samples: the numbers by which it is told."""

from __future__ import annotations


class Code:
    """Operations, as plain numbers: they are looked up by the thousand."""

    CONST = 0
    X = 1
    Y = 2
    ADD = 3
    SUB = 4
    MUL = 5
    DIV = 6
    MIN = 7
    MAX = 8
    LESS = 9
    LESS_EQUAL = 10
    ABS = 11
    FLOOR = 12
    SQRT = 13
    ADD_TO = 14  # with a constant
    TIMES = 15
    SELECT = 16
    WIDTH = 17
    SIN = 18
    COS = 19
    TAN = 20
    ATAN2 = 21
    EXP = 22
    LOG = 23
    POW = 24
    NOISE = 25
    WHITE = 26
    CELLS = 27
    RAMP = 28
    RANDOM = 29
    PICTURE = 30


# Nanoseconds a sample, about, on one core of 2024; of noise for each octave.
COST = dict.fromkeys(range(Code.PICTURE + 1), 0.5) | {
    Code.CONST: 0.0, Code.X: 0.1, Code.Y: 0.1, Code.DIV: 1.0, Code.SQRT: 1.0, Code.SIN: 8.0, Code.COS: 8.0,
    Code.TAN: 10.0, Code.ATAN2: 15.0, Code.EXP: 8.0, Code.LOG: 12.0, Code.POW: 40.0, Code.NOISE: 7.0,
    Code.WHITE: 30.0, Code.CELLS: 150.0, Code.RAMP: 10.0, Code.RANDOM: 3.0, Code.PICTURE: 0.5,
}  # fmt: skip
