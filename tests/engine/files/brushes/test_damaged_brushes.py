"""Whatever is cut off or altered in files of other programs' brushes is refused in a line, or gives brushes."""

import brush_bytes as w
from hypothesis import given, settings
from hypothesis import strategies as st
from test_tip_files import PARAMS, PRESETS

from engine.brush.settings import from_json
from engine.files.brushes.found_brush import FoundBrushes
from engine.files.brushes.gimp_tips import read_gbr, read_gih
from engine.files.brushes.krita_presets import read_kpp
from engine.files.brushes.mypaint_brushes import read_myb
from engine.files.brushes.photoshop_tips import read_abr
from engine.files.fault import FileError

MADE = {
    "gbr": (w.gbr(w.TIP), read_gbr),
    "gih": (w.gih([w.TIP, w.TIP]), read_gih),
    "records": (w.abr_of_records(2, (2, w.sampled(w.TIP, 1, "A")), (1, w.computed())), read_abr),
    "tips of form 1": (w.abr_of_blocks(1, {"tip-one": w.TIP}, PRESETS), read_abr),
    "tips of form 2": (w.abr_of_blocks(2, {"tip-one": w.TIP}, PRESETS), read_abr),
    "kpp": (w.kpp(PARAMS, "tEXt"), lambda data, file: read_kpp(data, file, {"bark.png": w.png(255 - w.TIP)}.get)),
    "myb": (
        w.myb(
            radius_logarithmic=(2.0, {"pressure": [[0, -1], [1, 1]], "speed1": [[0, 0], [4, -1]]}),
            elliptical_dab_ratio=(3.0, {"tilt_declination": [[0, 5], [90, 0]]}),
            elliptical_dab_angle=(9, {"direction": [[0, 0], [180, 180]], "tilt_ascension": [[-180, -90], [180, 90]]}),
            change_color_h=(0.0, {"random": [[0, -0.5], [1, 0.5]]}),
            stroke_duration_logarithmic=(3.0, {}),
            opaque=(0.7, {"stroke": [[0, 0], [1, -1]]}),
        ),
        read_myb,
    ),
}  # fmt: skip


def sound(data, read):
    try:
        found = read(bytes(data), "a.x")
    except FileError as error:
        line = str(error)
        found = FoundBrushes([])
    else:
        assert found.brushes
        line = "a.x: "
    assert line.startswith("a.x: ")
    assert "\n" not in line
    for brush in found.brushes:
        from_json(brush.settings)
        assert brush.tip is None or (brush.tip.ndim == 2 and brush.tip.shape[0] == brush.tip.shape[1])
        assert "\n" not in f"{brush.name}{brush.left}"


def test_whole_files_are_read():
    for data, read in MADE.values():
        assert read(data, "a.x").brushes


@settings(max_examples=250, deadline=None)
@given(st.sampled_from(sorted(MADE)), st.data())
def test_altered_bytes_are_refused_or_read(name, drawn):
    data, read = bytearray(MADE[name][0]), MADE[name][1]
    for _ in range(drawn.draw(st.integers(1, 3))):
        data[drawn.draw(st.integers(0, len(data) - 1))] = drawn.draw(st.integers(0, 255))
    sound(data, read)


@settings(max_examples=200, deadline=None)
@given(st.sampled_from(sorted(MADE)), st.floats(0, 1))
def test_files_that_end_early_are_refused_or_read(name, part):
    data, read = MADE[name]
    sound(data[: int(part * len(data))], read)
