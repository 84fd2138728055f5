"""Examples filled beside G'MIC's matchpatch: nearer to their examples by every figure that matters, or as near."""

import shutil
import subprocess

import numpy as np
import pytest
from PIL import Image

from bench.example import filling, photos
from bench.likeness import likeness, shuffled

pytestmark = [pytest.mark.nightly, pytest.mark.timeout(600)]
SIDE = 512
NAMES = "gravel", "grass", "brick", "printed paper"
SEAMS = 1.15  # times theirs, at most: visible breaks


@pytest.fixture(scope="module")
def pictures():
    pytest.importorskip("skimage")
    return photos(200)


@pytest.mark.parametrize("name", NAMES)
def test_scores_are_better_than_those_of_matchpatch(pictures, name, tmp_path):
    command = shutil.which("gmic")
    if command is None:
        pytest.skip("gmic is not installed")
    given, out = tmp_path / "in.png", tmp_path / "out.png"
    pixels = pictures[name]
    Image.fromarray(pixels[..., :3].copy()).save(given)
    words = [command, str(given), "-syntexturize_matchpatch", f"{SIDE},{SIDE}", "-o", str(out)]
    subprocess.run(words, check=True, capture_output=True)
    example = pixels[..., :3] / 255.0
    worst = likeness(example, shuffled(example, np.ones((SIDE, SIDE), bool)))
    theirs = likeness(example, np.asarray(Image.open(out).convert("RGB")) / 255.0)
    ours = likeness(example, filling(pixels, SIDE)()[..., :3] / 255.0)
    assert ours.score(worst) < theirs.score(worst)
    assert ours.nn95 < max(SEAMS * theirs.nn95, 0.15)  # letters that break off are few in any page
    assert ours.rep <= max(0.04, theirs.rep)
