"""Elementary functions: right to a unit of the last place, the same compiled and plain, and the same bits as ever.

What they hash to stands here: it was found with AVX-512 and FMA, and without AVX and FMA.  So a test that passes says
that this processor, and these versions of NumPy and numba, give these bits, too.
"""

import hashlib
import math

import numpy as np
import pytest

from engine.numeric import elementary as e

COUNT = 20_000
WIDE = {"exp": (-745, 709), "exp2": (-1070, 1020), "expm1": (-5, 5), "log1p": (-0.99, 50)}
ANGLES = (1.0, 50.0, 1e6)
UNITS = {"tan": 2.5, "expm1": 2.5, "sin": 0.8, "cos": 0.8}
FUNCTIONS = {f.__name__: f for f in e._MAPPED}
NUMPYS = {"atan": "arctan"}
EXPONENTS = (0.3, 2.2, -1.7, 31.0, -0.004)


def spread(name):
    """Values all over where a function is of interest."""
    random = np.random.default_rng(1)
    if name in WIDE:
        parts = [random.uniform(*WIDE[name], COUNT), random.uniform(-0.7, 0.7, COUNT)]
        return np.concatenate([*parts, random.uniform(-1e-9, 1e-9, 100)])
    if name in ("log", "log2"):
        parts = [
            2.0 ** random.integers(-1074, 1024, COUNT) * random.uniform(1, 2, COUNT),
            random.uniform(0.5, 2, COUNT),
        ]
        return np.concatenate([*parts, 1.0 + random.uniform(-1e-6, 1e-6, 100)])
    if name == "atan":
        return random.choice([-1.0, 1.0], 2 * COUNT) * 2.0 ** random.uniform(-40, 40, 2 * COUNT)
    return np.concatenate([random.uniform(-most, most, COUNT) for most in ANGLES])


def units(found, right):
    """How far values are from the right ones, in units of the last place."""
    unit = np.spacing(np.maximum(np.abs(right.astype(np.float64)), 2.0**-1021))
    return float(np.max(np.abs(found.astype(np.longdouble) - right) / unit))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_it_is_right_to_a_unit_and_the_same_plain(name):
    x = spread(name)
    found = e.mapped(FUNCTIONS[name], x)
    assert units(found, getattr(np, NUMPYS.get(name, name))(x.astype(np.longdouble))) < UNITS.get(name, 0.7)
    some = x[:: len(x) // 200]
    assert e.mapped(FUNCTIONS[name], some).tolist() == [FUNCTIONS[name](float(v)) for v in some]


def test_powers_and_angles_are_right_to_a_unit():
    random = np.random.default_rng(2)
    x = 2.0 ** random.uniform(-30, 30, COUNT)
    for exponent in EXPONENTS:
        right = np.power(x.astype(np.longdouble), np.longdouble(exponent))
        assert units(e.powers(x, exponent), right) < 0.7
        assert e.powers(x[:50], exponent).tolist() == [e.power(float(v), exponent) for v in x[:50]]
    down, across = random.uniform(-9, 9, (2, COUNT))
    assert units(e.angles(down, across), np.arctan2(down.astype(np.longdouble), across)) < 0.7


def test_large_angles_are_right():
    x = 2.0 ** np.random.default_rng(3).uniform(20, 1023, 5000)
    for own, theirs in ((e.sin, np.sin), (e.cos, np.cos)):
        assert np.abs(e.mapped(own, x) - theirs(x)).max() < 2.0**-52
        assert e.mapped(own, -x[:20]).tolist() == [own(-float(v)) for v in x[:20]]


def test_powers_of_two_are_exact():
    for n in range(-1074, 1024):
        assert e.exp2(float(n)) == math.ldexp(1.0, n)
        assert e.log2(math.ldexp(1.0, n)) == n


_ENDS = {math.log: 0.0, math.log2: 0.0, math.log1p: -1.0}
SPECIAL = [0.0, -0.0, 1.0, -1.0, 5e-324, -5e-324, 2.0**-1022, 1e308, -1e308, math.inf, -math.inf, math.nan]


def plain(function, *values):
    try:
        return function(*values)
    except OverflowError:
        return math.inf
    except ValueError:
        return -math.inf if values[0] == _ENDS.get(function) else math.nan


@pytest.mark.parametrize("name", FUNCTIONS)
def test_what_is_no_common_number_is_as_in_c(name):
    wanted = [plain(getattr(math, name), x) for x in SPECIAL]
    for found in ([FUNCTIONS[name](x) for x in SPECIAL], e.mapped(FUNCTIONS[name], np.array(SPECIAL)).tolist()):
        near = np.isclose(found, wanted, rtol=1e-15, atol=2.0**-52, equal_nan=True)
        assert near.all()


def test_powers_and_angles_of_what_is_no_common_number_are_as_in_c():
    for x in SPECIAL:
        for y in (*SPECIAL, 0.5, 3.0, -2.0, 1e300):
            assert e.atan2(x, y) == pytest.approx(math.atan2(x, y), rel=1e-15, nan_ok=True)
            if x >= 0.0 and not (x == 0.0 and y < 0.0):  # Python refuses these
                assert e.power(abs(x), y) == pytest.approx(plain(math.pow, abs(x), y), rel=1e-15, nan_ok=True)
    assert e.power(0.0, -1.0) == math.inf
    assert math.isnan(e.power(-1.0, 2.0))


def test_float32_is_worked_out_in_float64():
    x = np.linspace(0.1, 9.0, 1000, dtype=np.float32).reshape(10, 100)
    found = e.mapped(e.log, x)
    assert found.dtype == np.float32
    assert found.shape == x.shape
    assert np.array_equal(found, e.mapped(e.log, x.astype(np.float64)).astype(np.float32))


def test_they_give_the_same_bits_as_ever():
    """On every processor: inputs are made of whole numbers, so that they are the same everywhere."""
    digest = hashlib.sha256()
    n = np.arange(1, 40_001, dtype=np.float64)
    for name, function in FUNCTIONS.items():
        low, high = WIDE.get(name, (-1000, 1000))
        x = low + (high - low) * ((n * 7919.0) % 40009.0) / 40009.0
        digest.update(e.mapped(function, np.abs(x) if name in ("log", "log2") else x).tobytes())
    for exponent in EXPONENTS:
        digest.update(e.powers(n / 377.0, exponent).tobytes())
    digest.update(e.angles((n * 7919.0) % 40009.0 - 20000.0, (n * 104729.0) % 40009.0 - 20000.0).tobytes())
    assert digest.hexdigest()[:24] == "8af4b8ea663090044151610d"
