"""The window by the profile of the screen, and the soft proof on its key: what is seen changes, and nothing else."""

import pytest
from PIL import ImageCms

pytestmark = pytest.mark.window
SRGB = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()


def swapped():
    """sRGB's profile with its primaries the other way round: what is meant red is sent as blue."""
    return SRGB.replace(b"rXYZ", b"????").replace(b"bXYZ", b"rXYZ").replace(b"????", b"bXYZ")


def test_the_window_is_sent_by_the_profile_and_what_is_painted_stays(program, tmp_path):
    path, folder = tmp_path / "swapped.icc", tmp_path / "config" / "inkfall"
    path.write_bytes(swapped())
    folder.mkdir(parents=True)
    (folder / "preferences.toml").write_text(f'[display]\nprofile = "{path}"\nproof = "{path}"\n')
    app = program()
    app.settled()
    app.box("status: Profile")
    app.keys("1")
    empty = app.canvas()
    app.stroke(*((440 + 8 * i, 320 + 5 * i) for i in range(16)))
    seen = app.canvas_unlike(empty)
    app.keys("shift+j")
    app.box("status: Soft proof")
    app.keys("shift+j")
    app.box("status: Profile")
    app.keys("ctrl+comma")
    app.click("Display", "Preferences")
    app.click("screen profile")
    app.click("Sent as they are")
    app.click("Close", "Preferences")
    app.box("status: Proof off")
    plain = app.canvas()
    assert (plain[..., 0] < plain[..., 2] - 10).any()  # the pencil is blue
    assert abs(seen - plain[..., ::-1]).max() <= 1
