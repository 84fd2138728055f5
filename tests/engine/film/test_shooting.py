"""Films frame by frame: as sharp as the painting, without a jump or a shimmer, and made of few pictures."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.film.aim import Aim, aim_at, aim_of
from engine.film.beats import beats, seen_from
from engine.film.replaying import Replaying
from engine.film.sheets import Sheets, plan
from engine.film.shooting import Film, Shooting, frame_of
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.recording import Header, Recording
from engine.session.apply import STEPS
from engine.session.replay import replay
from engine.studio.filing.filming import making_of

SIZE = 160, 90
FRAME = Rect(0, 0, 160, 90)


def stroke(points, radius=9.0, level=0, **more):
    brush = {"radius": radius, "dynamics": {}, **more.pop("brush", {})}
    return {"do": "stroke", "level": level, "points": points, "brush": brush, **more}


INK = [{"texture": "rock", "amount": 0.8, "colour": "#ffe0a0", "period": 24, "roughness": 0.9}]
PAINTED = [
    {"do": "layer", "add": "One"},
    stroke([[20, 45], [140, 45]], 60, brush={"colour": "#305070", "ink": INK}),
    stroke([[30, 20], [60, 60], [120, 30]], 6, brush={"colour": "#c02010"}),
    stroke([[300, 200], [360, 220]], 5, level=2, brush={"colour": "#20c040"}),
]


def recorded(lines, frame=FRAME):
    return Recording(Header(frame, 7), tuple(parse(line) for line in lines))


@pytest.fixture(scope="module")
def painting():
    return replay(recorded(PAINTED)).painting


def seen(painting, level, rect):
    """The picture itself, over paper: float64 (3, h, w)."""
    pixels = composite(painting.root, level, rect, layer_planes).astype(np.float64)
    return pixels[:3] + 1.0 - pixels[3]


def shot(film, painting=None):
    return [frame.copy() for frame in Shooting(film, painting).frames(2)]


def test_a_still_film_is_the_picture_itself(painting):
    place = Rect.at(400, 200, *SIZE)
    frames = shot(Film((aim_at(3, place, SIZE),), SIZE, 4.0, 1.0), painting)
    assert len(frames) == 4
    assert np.array_equal(frames[0], np.floor(seen(painting, 3, place) * 255.0 + 0.5).transpose(1, 2, 0))
    assert all(np.array_equal(frame, frames[0]) for frame in frames)


def test_a_flight_takes_a_picture_a_level():
    wide = 1920, 1080
    start = aim_at(0, Rect.at(0, 0, *wide), wide)
    end = aim_at(12, Rect.at(4_097_939, 1_933_342, *wide), wide)
    shooting = Shooting(Film((start, end), wide, 60.0, 12.0))
    made = plan(shooting.aims(), wide).sheets
    assert sorted(sheet.level for sheet in made) == list(range(13))
    assert all(sheet.rect.width <= 2 * wide[0] + 200 and sheet.rect.height <= 2 * wide[1] + 200 for sheet in made)
    glances = plan(shooting.aims(), wide).frames
    assert all(0.999 < glance.window.step < 2.001 or glance.share < 1.0 for frame in glances for glance in frame)


def resampled(painting, aim, finer=2):
    """A perfect picture: evaluated so many levels nearer, and resampled by a Lanczos filter: float64 (h, w, 3)."""
    window = aim.window(SIZE, aim.level + finer)
    rect = window.rect.grown(3 * int(window.step + 1))
    rows, columns = (
        lanczos(edge + far, window.step, count, length)
        for edge, far, count, length in (
            (window.y - rect.y0, window.top, SIZE[1], rect.height),
            (window.x - rect.x0, window.left, SIZE[0], rect.width),
        )
    )
    return np.clip(np.einsum("ij,cjk,lk->ilc", rows, seen(painting, window.level, rect), columns, optimize=True), 0, 1)


def lanczos(start, step, count, length):
    places = start + (np.arange(count) + 0.5) * step - 0.5
    x = (np.arange(length) - places[:, None]) / step
    weights = np.sinc(x) * np.sinc(x / 3) * (np.abs(x) < 3)
    return weights / weights.sum(axis=1, keepdims=True)


def resampled_askew(painting, aim, finer=1):
    """A perfect picture of a place that is seen turned, or mirrored: float64 (h, w, 3)."""
    window = aim.window(aim.across(SIZE), aim.level + finer)
    rect = window.rect.grown(3 * int(window.step + 1))
    pixels = seen(painting, window.level, rect)
    right, down = np.meshgrid(np.arange(SIZE[0]) + 0.5 - SIZE[0] / 2, np.arange(SIZE[1]) + 0.5 - SIZE[1] / 2)
    cos, sin = window.step * np.cos(aim.turn), window.step * np.sin(aim.turn)
    flip = -1.0 if aim.mirrored else 1.0
    middle = [
        edge + far + count * window.step / 2
        for edge, far, count in zip(
            (window.x - rect.x0, window.y - rect.y0), (window.left, window.top), window.size, strict=True
        )
    ]
    x = middle[0] + flip * (cos * right + sin * down) - 0.5
    y = middle[1] - sin * right + cos * down - 0.5
    reach = 3 * int(np.ceil(window.step))
    out, whole = 0.0, 0.0
    for j in range(-reach, reach + 1):
        for i in range(-reach, reach + 1):
            column, row = np.rint(x).astype(int) + i, np.rint(y).astype(int) + j
            weights = 1.0
            for far in ((column - x) / window.step, (row - y) / window.step):
                weights = weights * np.sinc(far) * np.sinc(far / 3) * (np.abs(far) < 3)
            out, whole = out + weights * pixels[:, row, column], whole + weights
    return np.clip(out / whole, 0, 1).transpose(1, 2, 0)


def test_what_is_turned_and_mirrored_is_seen_so(painting):
    """As bookmarks tell it: the rectangle upright on the picture, the canvas turned clockwise about its middle."""
    place = Rect.at(400, 200, *SIZE)
    upright = shot(Film((aim_at(3, place, SIZE),), SIZE, 1.0, 1.0), painting)[0]

    def marked(**more):
        mark = parse({"do": "bookmark", "name": "a", "level": 3, "origin": [400, 200], "size": list(SIZE), **more})
        return aim_of(mark, SIZE)

    def still(aim):
        return shot(Film((aim,), SIZE, 1.0, 1.0), painting)[0]

    assert np.array_equal(still(marked()), upright)
    assert np.array_equal(still(marked(mirror=True)), upright[:, ::-1])
    assert np.array_equal(still(marked(angle=180)), upright[::-1, ::-1])
    square = Rect.at(400 + 35, 200, 90, 90)
    turned = shot(Film((replace(aim_at(3, square, (90, 90)), turn=np.pi / 2),), (90, 90), 1.0, 1.0), painting)[0]
    assert np.array_equal(turned, np.rot90(upright[:, 35:125], -1))
    for aim in (marked(angle=33), marked(angle=-75, mirror=True), marked(angle=10).at(3, 0.3)):
        off = still(aim) - 255.0 * resampled_askew(painting, aim)
        assert np.abs(off).mean() < 2.5, aim


def changes(frames):
    return np.array([np.abs(b.astype(float) - a).mean() for a, b in pairwise(frames)])


@pytest.mark.parametrize("sideways", [0.0, 3.0])
def test_a_slow_flight_does_not_shimmer(painting, sideways):
    """Neighbouring frames differ by less than 1.5 x what perfectly resampled pictures do, and nothing jumps where the
    flight comes to a level."""
    start = aim_at(2, Rect.at(300, 160, *SIZE), SIZE)
    aims = [start.at(2, 0.7 + 0.025 * i).moved(sideways * i, 0.5 * sideways * i) for i in range(25)]
    with ThreadPoolExecutor(2) as pool:
        sheets = Sheets(plan(aims, SIZE), pool)
        ours = changes([frame_of(sheets.parts(i, painting), SIZE, pool) for i in range(len(aims))])
    perfect = changes([np.rint(255 * resampled(painting, aim)) for aim in aims])
    assert (ours < 1.5 * perfect).all(), (ours / perfect).max()
    assert ours.mean() > 0.6 * perfect.mean()  # nor is it merely blurred


def test_a_flight_turns_without_a_jump_and_without_a_shimmer(painting):
    start = aim_at(3, Rect.at(400, 200, *SIZE), SIZE)
    end = replace(start.at(3, 0.6), turn=np.radians(50.0))
    aims = Shooting(Film((start, end), SIZE, 20.0, 4.0)).aims()
    assert np.allclose([aim.turn / end.turn for aim in aims], [(aim.level - 3 + aim.fraction) / 0.6 for aim in aims])
    aims = [start, *aims[30:35]]
    with ThreadPoolExecutor(2) as pool:
        sheets = Sheets(plan(aims, SIZE), pool)
        ours = changes([frame_of(sheets.parts(i, painting), SIZE, pool) for i in range(len(aims))][1:])
    perfect = changes([np.rint(255 * resampled_askew(painting, aim)) for aim in aims[1:]])
    assert (ours < 1.5 * perfect).all(), (ours / perfect).max()
    assert ours.mean() > 0.6 * perfect.mean()


def test_a_flight_to_a_mirrored_place_fades_over(painting):
    start = aim_at(3, Rect.at(400, 200, *SIZE), SIZE)
    frames = shot(Film((start, replace(start, mirrored=1.0)), SIZE, 20.0, 3.0), painting)
    assert np.array_equal(frames[-1], frames[0][:, ::-1])
    whole = np.abs(frames[-1].astype(float) - frames[0]).mean()
    assert changes(frames).max() < 0.12 * whole


REPLAYED = [
    {"do": "layer", "add": "One"},
    stroke([[20, 20, 1, 0, 0, 0], [140, 20, 1, 0, 0, 2]], brush={"colour": "#802020"}),
    stroke([[20, 70], [140, 70]], brush={"colour": "#208020"}),
    {"do": "undo"},
    stroke([[20, 45, 1, 0, 0, 0], [140, 45, 1, 0, 0, 3]], brush={"colour": "#202080"}, time=1000.0),
    stroke([[80, 10], [80, 80]], 5, brush={"mode": "erase"}, time=1005.0),
]


def test_beats_by_strokes_and_by_the_pen():
    commands = recorded(REPLAYED).commands
    assert [(b.begin, b.length) for b in beats(commands, STEPS) if b.seen] == [(0, 1), (1, 1), (2, 1)]
    assert [(b.begin, b.length) for b in beats(commands, STEPS, undone=True) if b.seen] == [(n, 1) for n in range(5)]
    # 2 s, a second that nobody told, 3 s, two seconds until the next began, and one for a stroke that tells no time.
    assert [(b.begin, b.length) for b in beats(commands, STEPS, "pen") if b.seen] == [(0, 2), (3, 3), (8, 1)]


def test_what_was_undone_and_done_again_is_seen():
    again = [*REPLAYED[:4], {"do": "redo"}]
    assert [beat.seen for beat in beats(recorded(again).commands, STEPS)] == [False, True, True, False, False]
    assert [beat.seen for beat in beats(recorded(again).commands, STEPS, undone=True)] == [
        False,
        True,
        True,
        True,
        True,
    ]


def test_what_a_film_of_one_place_could_not_show_takes_none_of_its_time():
    deep = stroke([[0, 0], [300, 0]], level=12, origin=[80 << 12, 45 << 12], brush={"radius": 40})
    beside = stroke([[500, 20], [600, 20]])
    commands = recorded([REPLAYED[1], deep, beside, REPLAYED[2]]).commands
    whole = seen_from(aim_at(0, FRAME, SIZE), SIZE)
    assert [(b.begin, b.length) for b in beats(commands, STEPS, sees=whole)] == [(0, 1), (1, 0), (1, 0), (1, 1)]
    near = seen_from(aim_at(12, Rect.at(80 << 12, 45 << 12, *SIZE), SIZE), SIZE)
    assert [near(command) for command in commands] == [False, True, False, False]


def test_a_replay_does_not_stand_still_while_what_is_too_small_is_painted():
    many = [
        stroke([[0, 0], [50 + n, 0]], level=14, origin=[80 << 14, 45 << 14], brush={"radius": 9}) for n in range(40)
    ]
    recording = recorded([REPLAYED[1], *many, REPLAYED[2]])
    frames = list(Shooting(Film((aim_at(0, FRAME, SIZE),), SIZE, 10.0, 4.0, making_of(recording))).frames(2))
    still = sum(np.array_equal(a, b) for a, b in pairwise(frames[:30]))
    assert still < 8
    assert np.array_equal(frames[-1], of(replay(recording).painting))


def of(painting):
    return np.floor(seen(painting, 0, FRAME) * 255.0 + 0.5).transpose(1, 2, 0)


@pytest.mark.parametrize("undone", [False, True])
def test_a_replay_shows_the_painting_as_it_was(undone):
    recording = recorded(REPLAYED)
    film = Film((aim_at(0, FRAME, SIZE),), SIZE, 10.0, 8.0, making_of(recording), undone=undone)
    shooting = Shooting(film)
    frames = list(shooting.frames(2))
    assert len(frames) == 80
    assert (frames[0] == 255).all()
    assert np.array_equal(frames[-1], of(replay(recording).painting))
    whole = {n: of(replay(recording.until(n)).painting) for n in range(1, len(recording.commands) + 1)}
    shown = [n for n in whole if any(np.array_equal(frame, whole[n]) for frame in frames)]
    # After each stroke a frame may fall on its end; those of what was undone are never seen unless asked for.
    assert 6 in shown
    green = np.array([32, 128, 32])
    assert any((frame == green).all(axis=2).any() for frame in frames) == undone
    # A stroke grows from frame to frame, left to right.
    inks = [(frame < 255).any(axis=2).sum() for frame in frames]
    assert sum(a < b for a, b in pairwise(inks[:21])) > 12


def test_a_painting_in_the_making_is_brought_up_to_date_where_it_changed():
    """Every frame of a flight over it is what it would be from pictures made anew."""
    recording = recorded([*PAINTED, *REPLAYED[1:]])
    times, aims = np.linspace(0.0, 7.0, 15), [aim_at(0, FRAME, SIZE).at(0, 0.1 * i) for i in range(15)]
    replaying = Replaying(making_of(recording), beats(recording.commands, STEPS))
    with ThreadPoolExecutor(2) as pool:
        sheets = Sheets(plan(aims, SIZE), pool)
        for i, time in enumerate(times):
            replaying.go_to(time)
            frame = frame_of(sheets.parts(i, replaying.painting), SIZE, pool)
            glances = replace(plan(aims, SIZE), frames=(plan(aims, SIZE).frames[i],))
            again = frame_of(Sheets(glances, pool).parts(0, replaying.painting), SIZE, pool)
            assert np.array_equal(frame, again), i


def test_the_brush_is_seen_where_it_touches():
    recording = recorded([stroke([[40, 45], [120, 45]], 12, brush={"colour": "#ffffff"})])
    film = Film((aim_at(0, FRAME, SIZE),), SIZE, 10.0, 2.0, making_of(recording))
    plain, marked = shot(film), shot(replace(film, brush=True))
    assert len(plain) == len(marked)
    found = [np.argwhere((a != b).any(axis=2)) for a, b in zip(plain, marked, strict=True)]
    middles = [places.mean(axis=0) for places in found if len(places)]
    assert len(middles) > 10
    assert np.allclose([y for y, _ in middles], 44.5, atol=0.6)
    assert all(a[1] < b[1] for a, b in pairwise(middles))
    assert not len(found[-1])  # lifted
    reach = np.ptp(found[5][:, 0])
    assert 24 <= reach <= 30


def test_deep_places_are_flown_to():
    """At level 60, where a double lost 17 bits: a still film there, and the end of a flight to it, are alike."""
    level, rect = 60, Rect.at((80 << 60) + 12345, (45 << 60) + 678, *SIZE)
    recording = recorded([*PAINTED, stroke([[20, 20], [120, 70]], 8, level=level, origin=[rect.x0, rect.y0])])
    painting = replay(recording).painting
    end = aim_at(level, rect, SIZE)
    flown = shot(Film((aim_at(0, FRAME, SIZE), end), SIZE, 4.0, 6.0), painting)
    still = shot(Film((end,), SIZE, 1.0, 1.0), painting)
    assert np.array_equal(flown[-1], still[0])
    assert np.array_equal(still[0], np.floor(seen(painting, level, rect) * 255 + 0.5).transpose(1, 2, 0))
    assert Aim(level, 0.0, end.x, end.y) == end
