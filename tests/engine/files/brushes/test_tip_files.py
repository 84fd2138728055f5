"""Tips of GIMP, Photoshop and Krita come in pixel for pixel, and what tells how they are painted with."""

import base64
import struct

import brush_bytes as w
import numpy as np
import pytest

from engine.brush import settings
from engine.files.brushes.brush_files import ENDINGS, read_brushes
from engine.files.brushes.found_brush import encircled
from engine.files.brushes.gimp_tips import read_gbr, read_gih
from engine.files.brushes.krita_presets import read_kpp
from engine.files.brushes.photoshop_tips import read_abr
from engine.files.fault import FileError

DEEP = (w.TIP.astype(np.uint16) * 257).astype(">u2")


def holds(brush, pixels):
    """Whether a brush's tip holds a picture in its middle and nothing else, and all of it within its radius."""
    side = len(brush.tip)
    left, top = (side - pixels.shape[1]) // 2, (side - pixels.shape[0]) // 2
    inside = brush.tip[top : top + len(pixels), left : left + pixels.shape[1]]
    assert np.array_equal(inside, pixels)
    assert brush.tip.sum() == pixels.sum(dtype=int)
    y, x = np.nonzero(brush.tip)
    assert np.hypot(x + 0.5 - side / 2, y + 0.5 - side / 2).max() + 0.5 <= side / 2
    settings.from_json(brush.settings)
    return True


def only(found):
    (brush,) = found.brushes
    return brush


@pytest.mark.parametrize("version", [1, 2])
def test_a_tip_of_gimp_comes_in_pixel_for_pixel(version):
    brush = only(read_gbr(w.gbr(w.TIP, version=version), "a.gbr"))
    assert (brush.name, brush.left) == ("Leaf ü", ())
    assert holds(brush, w.TIP)
    assert brush.settings["radius"] * 2 == len(brush.tip)
    step = brush.settings["spacing"] * brush.settings["radius"]
    assert step == pytest.approx({1: 0.20, 2: 0.30}[version] * 14)


def test_a_coloured_tip_of_gimp_is_its_alpha_and_says_so():
    pixels = np.dstack([np.full((9, 14), 200), np.arange(126).reshape(9, 14), w.TIP, w.TIP]).astype(np.uint8)
    brush = only(read_gbr(w.gbr(pixels, ""), "leaf one.gbr"))
    assert (brush.name, brush.left) == ("leaf one", ("its tip's own colours",))
    assert holds(brush, w.TIP)


def test_of_several_tips_the_first_is_taken_and_the_others_are_told():
    brush = only(read_gih(w.gih([w.TIP, w.TIP[:4], w.TIP[:5]]), "a.gih"))
    assert (brush.name, brush.left) == ("Leaves", ("2 of its 3 tips",))
    assert holds(brush, w.TIP)


@pytest.mark.parametrize("packed", [0, 1])
@pytest.mark.parametrize("pixels", [w.TIP, np.full((5, 300), 7, np.uint8), DEEP], ids=["grain", "runs", "deep"])
def test_records_of_photoshop_come_in_raw_and_packed(pixels, packed):
    data = w.abr_of_records(
        2, (2, w.sampled(pixels, packed, "Bark")), (1, w.computed()), (2, w.sampled(pixels, packed, "", 100))
    )
    found = read_abr(data, "two.abr")
    assert [brush.name for brush in found.brushes] == ["Bark", "two 2", "two 3"]
    plain = pixels if pixels.itemsize == 1 else w.TIP
    assert holds(found.brushes[0], plain)
    assert holds(found.brushes[2], plain)
    told = found.brushes[1].settings
    assert (told["radius"], told["hardness"], told["spacing"]) == (20.0, 0.6, 0.5)
    assert told["shape"] == {"ratio": 0.5, "angle": 330.0}
    assert holds(only(read_abr(w.abr_of_records(1, (2, w.sampled(pixels, packed))), "one.abr")), plain)


SHAPE = {"Dmtr": 28.0, "Angl": 90.0, "Rndn": 50.0, "Spcn": 40.0, "sampledData": "tip-one"}
PRESETS = [
    ("brushPreset", {
        "Nm  ": "Reeds", "Brsh": ("sampledBrush", SHAPE), "useTipDynamics": True, "minimumDiameter": 20.0,
        "szVr": ("brVr", {"bVTy": 2}), "angleDynamics": ("brVr", {"bVTy": 7, "jitter": 50.0}), "useScatter": True,
        "scatterDynamics": ("brVr", {"jitter": 100.0}), "Cnt ": 3, "useTexture": True,
        "dualBrush": ("dualBrush", {"useDualBrush": True}),
    }),
    ("brushPreset", {"Nm  ": "Soft", "Brsh": ("computedBrush", {"Dmtr": 50.0, "Hrdn": 10.0, "Spcn": 25.0})}),
    ("brushPreset", {"Nm  ": "Lost", "Brsh": ("sampledBrush", {"sampledData": "no such"})}),
]  # fmt: skip


@pytest.mark.parametrize("minor", [1, 2])
@pytest.mark.parametrize("packed", [0, 1])
def test_blocks_of_photoshop_come_in_with_what_tells_of_them(minor, packed):
    data = w.abr_of_blocks(minor, {"tip-one": w.TIP, "tip-two": w.TIP[:5]}, PRESETS, packed)
    found = read_abr(data, "six.abr")
    assert [brush.name for brush in found.brushes] == ["Reeds", "Soft", "six 2"]
    assert found.left == ["“Lost”, whose tip is not there"]
    reeds = found.brushes[0]
    assert holds(reeds, w.TIP)
    assert holds(found.brushes[2], w.TIP[:5])
    told = reeds.settings
    assert told["radius"] == pytest.approx(len(reeds.tip) / 2 * 28 / 14)
    assert told["spacing"] * told["radius"] == pytest.approx(0.4 * 28)
    assert told["shape"] == {"ratio": 0.5, "angle": 270.0, "follow": "direction", "scatter": 2.0, "count": 3}
    assert told["dynamics"] == {
        "radius": [[0.0, 0.2], [1.0, 1.0]],
        "angle": {"random_dab": [[0.0, 0.75], [1.0, 1.25]]},
    }
    assert reeds.left == ("a pattern", "a second tip")


def test_what_is_wrong_with_one_brush_loses_no_other():
    good = w.sampled(w.TIP, 1, "Good")
    empty = w.sampled(np.zeros((3, 3), np.uint8), 0, "Empty")
    found = read_abr(w.abr_of_records(2, (2, good), (7, b"abc"), (2, empty), (2, good[:-9]), (2, good)), "a.abr")
    assert [brush.name for brush in found.brushes] == ["Good", "Good"]
    assert [line.partition(" (")[0] for line in found.left] == ["brush 2", "brush 3", "brush 4"]
    told = w.abr_of_blocks(2, {"a": w.TIP}, [("brushPreset", {"Nm  ": "A", "Brsh": ("sampledBrush", SHAPE)})])
    found = read_abr(told[:-30], "b.abr")
    assert [brush.name for brush in found.brushes] == ["b 1"]
    assert [line.partition(" (")[0] for line in found.left] == [
        "its last 30 bytes, which are missing",
        "the settings of its brushes",
    ]


DARK = 255 - w.TIP  # Krita's tips paint where they are dark
BRUSH = '<Brush type="png_brush" filename="bark.png" spacing="0.5" scale="2" angle="0"/>'
CURVE = '<!DOCTYPE params><params id="pressure"><curve>0,0.25;1,1;</curve></params>'
PARAMS = {
    "brush_definition": BRUSH,
    "OpacityValue": "0.5",
    "PressureSize": "true",
    "SizeSensor": CURVE,
    "PressureRotation": "true",
    "RotationSensor": '<params id="drawingangle"/>',
    "EraserMode": "true",
    "Texture/Pattern/Enabled": "true",
}


@pytest.mark.parametrize("kind", ["tEXt", "zTXt", "iTXt"])
def test_a_preset_of_krita_has_the_tip_beside_it(kind):
    data = w.kpp(PARAMS, kind)
    brush = only(read_kpp(data, "a.kpp", {"bark.png": w.png(DARK)}.get))
    assert (brush.name, brush.left) == ("b) My brush", ("its pattern",))
    assert holds(brush, w.TIP)
    told = brush.settings
    assert told["radius"] == len(brush.tip)
    assert told["spacing"] * told["radius"] == pytest.approx(0.5 * 2 * 14)
    assert (told["mode"], told["opacity"], told["shape"]["follow"]) == ("erase", 0.5, "direction")
    assert told["dynamics"] == {"radius": {"pressure": [[0.0, 0.25], [1.0, 1.0]]}}


def test_a_preset_of_krita_has_the_tip_within_it_or_says_that_there_is_none():
    inside = base64.b64encode(w.png(DARK)).decode()
    held = f'<resources><resource type="brushes" filename="bark.png">{inside}</resource></resources>'
    assert holds(only(read_kpp(w.kpp(PARAMS, resources=held), "a.kpp", {}.get)), w.TIP)
    stamp = {"brush_definition": BRUSH.replace("bark.png", "bark.gbr")}
    assert holds(only(read_kpp(w.kpp(stamp), "a.kpp", {"bark.gbr": w.gbr(w.TIP)}.get)), w.TIP)
    brush = only(read_kpp(w.kpp(PARAMS, engine="spraybrush"), "a.kpp", {}.get))
    assert brush.tip is None
    assert brush.left == ("what Krita's “spraybrush” does", "its pattern", "its tip “bark.png”, which is not beside it")


def test_opacity_and_flow_of_krita_follow_where_their_curve_is_used():
    params = {"OpacitySensor": CURVE, "OpacityUseCurve": "true", "FlowSensor": CURVE, "FlowUseCurve": "false"}
    told = only(read_kpp(w.kpp(params | {"SizeSensor": CURVE, "SizeUseCurve": "true"}), "a.kpp", {}.get)).settings
    assert told["dynamics"] == {"opacity": {"pressure": [[0.0, 0.25], [1.0, 1.0]]}}


def test_a_coloured_tip_of_krita_is_its_alpha_unless_it_is_a_mask():
    pixels = np.dstack([np.full((9, 14), 90), np.full((9, 14), 30), np.full((9, 14), 30), w.TIP]).astype(np.uint8)
    assert holds(only(read_kpp(w.kpp(PARAMS), "a.kpp", {"bark.png": w.png(pixels)}.get)), w.TIP)
    masked = {"brush_definition": BRUSH.replace("/>", ' ColorAsMask="1"/>')}
    darker = np.rint(205.0 * (w.TIP / np.float32(255))).astype(np.uint8)
    assert holds(only(read_kpp(w.kpp(masked), "a.kpp", {"bark.png": w.png(pixels)}.get)), darker)


def test_a_round_tip_of_krita_is_told_by_numbers():
    mask = '<MaskGenerator type="circle" diameter="40" ratio="0.5" hfade="0.75" vfade="0.75" spikes="2"/>'
    auto = f'<Brush type="auto_brush" useAutoSpacing="0" spacing="0.1" angle="0">{mask}</Brush>'
    told = only(read_kpp(w.kpp({"brush_definition": auto}), "a.kpp", {}.get)).settings
    assert (told["radius"], told["hardness"], told["spacing"]) == (20.0, 0.75, 0.2)
    assert told["shape"]["ratio"] == 0.5


def test_a_preset_names_no_file_elsewhere(tmp_path):
    (tmp_path / "secret.png").write_bytes(w.png(DARK))
    (tmp_path / "presets").mkdir()
    (tmp_path / "brushes").mkdir()
    (tmp_path / "brushes" / "bark.png").write_bytes(w.png(DARK))
    path = tmp_path / "presets" / "a.KPP"
    path.write_bytes(w.kpp(PARAMS))
    assert holds(only(read_brushes(path)), w.TIP)
    for name in ("../secret.png", "..", "/etc/passwd", "a\\..\\..\\secret.png"):
        path.write_bytes(w.kpp({"brush_definition": BRUSH.replace("bark.png", name)}))
        assert only(read_brushes(path)).tip is None


def test_a_large_tip_is_kept_smaller_and_its_circle_holds_it():
    pixels = np.zeros((1500, 2100), np.uint8)
    pixels[::10] = 255
    square, radius = encircled(pixels)
    assert len(square) <= 1024
    assert 2 * radius == np.ceil(np.hypot(2100, 1500)) + 1 or abs(2 * radius - np.hypot(2100, 1500)) < 12
    assert abs(square.mean(dtype=float) * (2 * radius) ** 2 / pixels.sum(dtype=float) - 1) < 0.02


ENTITY = b'<!DOCTYPE a [<!ENTITY b "c">]><Preset>&b;</Preset>'
HOSTILE = {
    "empty": (".gbr", b""),
    "a version of tomorrow": (".gbr", w.gbr(w.TIP, version=3)),
    "a huge tip": (".gbr", struct.pack(">5I4sI", 30, 2, 1 << 31, 1 << 31, 1, b"GIMP", 1) + b"a\0"),
    "a tip of many pixels": (".gbr", struct.pack(">5I4sI", 30, 2, 9999, 9999, 4, b"GIMP", 1) + b"a\0"),
    "a head of a gigabyte": (".gbr", struct.pack(">5I4sI", 1 << 30, 2, 5, 5, 1, b"GIMP", 1)),
    "nothing covered": (".gbr", w.gbr(np.zeros((4, 4), np.uint8))),
    "a pipe of tips without number": (".gih", b"a\nmany\n"),
    "a line without end": (".gih", b"a" * 100_000),
    "another version": (".abr", struct.pack(">HH", 5, 1)),
    "many brushes": (".abr", struct.pack(">HH", 2, 60_000)),
    "no block": (".abr", struct.pack(">HH", 6, 2) + b"8BPS" + bytes(20)),
    "no brush": (".abr", w.abr_of_blocks(2, {})),
    "no picture": (".kpp", b"no PNG"),
    "a picture": (".kpp", w.png(DARK)),
    "entities": (".kpp", w.png(DARK, w.png_chunk(b"tEXt", b"preset\0" + ENTITY))),
    "another root": (".kpp", w.png(DARK, w.png_chunk(b"tEXt", b"preset\0<a/>"))),
    "no XML": (".kpp", w.png(DARK, w.png_chunk(b"zTXt", b"preset\0\0abc"))),
    "an old brush": (".myb", b"version 2\nopaque 1.0\n"),
    "deep": (".myb", b"[" * 100_000),
    "not finite": (".myb", b'{"version": 3, "settings": {"opaque": {"base_value": 1e999}}}'),
    "no curve": (".myb", w.myb(opaque=(1.0, {"pressure": [[0]]}))),
    "no settings": (".myb", b'{"version": 3}'),
}  # fmt: skip


@pytest.mark.parametrize(("ending", "data"), HOSTILE.values(), ids=HOSTILE)
def test_what_is_no_brush_is_refused_in_a_line_that_names_the_file(ending, data, tmp_path):
    path = tmp_path / f"bad{ending}"
    path.write_bytes(data)
    with pytest.raises(FileError, match=r"^bad\.\w+: [^\n]+$"):
        read_brushes(path)
    assert ending in ENDINGS
