"""Maps of examples in the palette: drawn, painted with at once, kept in files; and the pen that is followed."""

from examples_at_hand import picture
from immutables import Map

from app.desk.examples import chart_state, chart_use, chart_work, example_state, example_use, example_work
from app.desk.examples.chart_state import ChartState, strokes_of
from engine.painting.commands import parse, to_json

FOLLOWED = Map({"orientation": "stroke"})


def drawn(desk, *points, kept=True):
    state = desk.examples
    for point in points:
        state.chart.extend(*point)
    chart_work.use(desk, state.chart.end(chart_use.maps_of(state, state.entry), kept))


def test_what_is_drawn_is_painted_with_and_kept(desk, own, tmp_path):
    example_work.add(desk, picture(tmp_path / "rock.png"))
    state = desk.examples
    assert not chart_use.runs(state, state.entry)
    assert not desk.hand.brush.control
    drawn(desk, (3, 4), (3.4, 4), (20.04, 8), kept=False)
    drawn(desk, (3, 4))  # a click tells no way
    assert not state.charts
    drawn(desk, (3, 4), (3.4, 4), (20.04, 8))
    assert desk.hand.brush.control == FOLLOWED
    maps = state.command(state.entry).arguments["maps"]
    assert maps == Map({"orientation": Map({"strokes": (Map({"points": ((3, 4), (20.0, 8))}),)})})
    assert any(need.arguments.get("maps") == maps for need in desk.hand.needs)
    state.chart.name = "size"
    state.chart.value, state.chart.radius = 0.5, 3.0
    drawn(desk, (9, 9))
    chart_work.use(desk, chart_state.with_rim_width(chart_use.maps_of(state, state.entry), 40))
    kept = chart_use.maps_of(state, state.entry)
    assert parse(to_json(state.command(state.entry))) == state.command(state.entry)
    chart_work.keep_maps(desk)
    assert not state.charts
    assert state.entry.maps == kept
    assert chart_state.rim_width(state.entry.maps) == 40
    example_work.rename(desk, state.entry, "Stone")  # which writes its file anew
    assert state.entry.maps == kept
    (found,), faults = example_state.load_examples(own, True)
    assert (found.maps, faults) == (kept, [])


def test_strokes_are_taken_back_and_drawn_again():
    chart, maps = ChartState(), Map()
    for x in (10.0, 20.0):
        chart.live = [(0.0, 0.0), (x, 0.0)]
        maps = chart.end(maps, True)
    once = chart.step(maps, True)
    assert len(strokes_of(once, "orientation")) == 1
    assert chart.step(once, False) == maps
    assert chart.step(maps, False) == maps
    assert chart.step(chart.step(maps, True), True).get("orientation") == Map({"strokes": ()})


def test_the_pen_is_followed_where_the_example_runs_somewhere(desk, tmp_path):
    state = desk.examples
    straw = next(entry for entry in state.entries if entry.name == "thatch")
    example_use.choose(desk, straw)
    assert desk.hand.brush.control == FOLLOWED
    assert "maps" not in state.command(straw).arguments  # its file tells them
    example_use.set_following(desk, False)
    assert not desk.hand.brush.control
    example_use.set_following(desk, True)
    assert not state.charts
    felt = next(entry for entry in state.entries if entry.name == "felt")
    example_use.choose(desk, felt)
    assert not desk.hand.brush.control
    example_use.set_following(desk, True)  # rightwards, as nothing else is known
    assert desk.hand.brush.control == FOLLOWED
    assert state.command(felt).arguments["maps"] == Map({"orientation": Map({"strokes": ()})})


def test_strokes_tell_a_map_a_number_or_nothing(desk):
    state = desk.examples
    example_use.choose(desk, next(entry for entry in state.entries if entry.name == "shingle"))
    assert chart_use.shades(state) == ("size",)
    assert chart_use.told_number(desk.hand.brush, "size") is None
    example_use.tell_number(desk, "size", 0.25)
    example_use.follow(desk)
    assert desk.hand.brush.control == Map({"size": 0.25})
    assert chart_use.told_number(desk.hand.brush, "size") == 0.25
    for _ in range(2):
        example_use.tell_number(desk, "size", None)
        assert not desk.hand.brush.control
    example_use.choose(desk, next(entry for entry in state.entries if entry.name == "thatch"))
    assert chart_use.shades(state) == ()


def test_paths_of_maps_start_from_the_examples_folder(tmp_path):
    picture(tmp_path / "a.png")
    (tmp_path / "a.toml").write_text('maps.size = "sizes.png"\n')
    (entry,), _ = example_state.load_examples(tmp_path, True)
    assert entry.maps == Map({"size": Map({"path": str(tmp_path / "sizes.png")})})
