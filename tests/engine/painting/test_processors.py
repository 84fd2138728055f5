"""A recording of version 2 gives the same bits on every processor: all that recordings can do is played as this one
works, and as one without AVX and FMA does."""

import json
import os
import subprocess
import sys
from pathlib import Path

import everything
import numpy as np
import pytest

ROOT = Path(__file__).parents[3]
PLAYER = Path(everything.__file__)


def plain_processor():
    """What a process is told to work as if there were no AVX and no FMA."""
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

    names = [name for name in __cpu_dispatch__ if __cpu_features__.get(name)]
    return {
        "NUMBA_CPU_NAME": "generic",
        "NPY_DISABLE_CPU_FEATURES": " ".join(names),
        "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX2_Usable,-FMA_Usable",
        "OPENBLAS_CORETYPE": "Prescott",
    }


def played(folder, told, version, *names):
    """{name: hashes} of what a process of its own plays, its kernels in `folder`."""
    folder.mkdir()
    given = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join((str(ROOT), str(PLAYER.parent))),
        "XDG_CACHE_HOME": str(folder / "cache"),
        **told,
    }
    given.pop("NUMBA_CACHE_DIR", None)
    command = [sys.executable, str(PLAYER), str(folder.parent), str(version), *names]
    done = subprocess.run(command, cwd=folder, env=given, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def both(tmp_path_factory):
    """What every recording hashes to, here and as on a plain processor."""
    folder = tmp_path_factory.mktemp("pictures")
    everything.pictures(folder)
    return played(folder / "here", {}, 2), played(folder / "plain", plain_processor(), 2)


@pytest.mark.nightly
@pytest.mark.parametrize("name", everything.recordings())
def test_a_recording_gives_the_same_bits_on_a_plain_processor(both, name):
    here, plain = both
    assert len(here[name]) == 2, here[name]  # it plays
    assert here[name] == plain[name]


def test_the_plain_processor_is_another_one():
    """The C library's and NumPy's functions differ there: else the proof would prove nothing."""
    text = (
        "import hashlib, math, numpy as np; x = np.arange(1, 9000) / 997.0;"
        "print(hashlib.sha256(np.array([math.exp(v) for v in x] + [math.sin(v) for v in x])).hexdigest(),"
        "hashlib.sha256(np.log(x) + np.sin(x)).hexdigest())"
    )
    here, plain = (
        subprocess.run([sys.executable, "-c", text], env={**os.environ, **told}, capture_output=True, text=True)
        for told in ({}, plain_processor())
    )
    assert not plain.stderr
    if not plain_processor()["NPY_DISABLE_CPU_FEATURES"]:
        pytest.skip("this processor has no AVX2")
    assert all(a != b for a, b in zip(here.stdout.split(), plain.stdout.split(), strict=True))


def test_they_are_all_that_recordings_can_do():
    """Every row of every table is among them."""
    from engine.brush.modes import MODES
    from engine.brush.ops import OPS
    from engine.makers.makers import MAKERS
    from engine.numeric.blend import BLENDS
    from engine.numeric.curves import CURVES, EDGES
    from engine.numeric.formula import FUNCTIONS

    commands = [command for each in everything.recordings().values() for command in each]
    text = json.dumps(commands)
    brushes = [command["brush"] for command in commands if command["do"] == "stroke"]
    assert {brush.get("mode", "paint") for brush in brushes} == set(MODES)
    assert {brush["op"].get("name") for brush in brushes if "op" in brush} == {*OPS, None}
    assert {command["blend"] for command in commands if "blend" in command} == set(BLENDS)
    made = {command["maker"] for command in commands if command["do"] == "texture"}
    assert {name for name, make in MAKERS.items()} <= made | {
        part["texture"] for b in brushes for part in b.get("ink", ())
    }
    for name in (*CURVES, *EDGES, *FUNCTIONS):
        assert name in text
    assert np.unique(list(everything.recordings())).size == len(everything.recordings())
