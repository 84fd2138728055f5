"""inkfall/manifest.json: what a painting's file holds, in words, and how its tree is told.

All numbers in our members are little-endian, pixel values whole multiples of 2^-16, or 2^-12 in layers of a painting of
that grid, premultiplied and sRGB-encoded.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from immutables import Map

from engine.archive import grounds, plot_files
from engine.archive.grounds import GroundEntry
from engine.archive.held_inks import held_inks
from engine.archive.implied import TEXTURES
from engine.archive.others.lost_sources import layers_instead, lost_sources, told_of
from engine.archive.plot_files import ExampleEntry, PlotEntry
from engine.archive.selected import selection_files
from engine.archive.selected.selection_files import Chosen, SelectionEntry
from engine.brush.checks import frozen, thawed
from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.placing import loops
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose
from engine.canvas.store import Pyramid
from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields
from engine.numeric.address import TILE, Rect
from engine.numeric.arithmetic import EVERYWHERE, FINE, LIBRARY
from engine.painting.commands import PLACE_LIMIT, SEED_LIMIT
from engine.painting.guiding.guides import NO_GUIDES, Guides, read_guides, write_guide
from engine.painting.layering.placing_members import Placing, read_part, read_placing, write_part, write_placing
from engine.painting.layering.role_members import role_kept, written_role
from engine.painting.layering.touch_command import NO_TOUCHES, Touches, read_touches, write_touches
from engine.painting.places import NO_BOOKMARKS, Bookmarks, read_bookmarks, write_bookmark
from engine.painting.recording import SIDE_LIMIT, read_grid, read_paper
from engine.painting.textures import Texture
from engine.painting.value import Painting
from engine.texture.example import SYNTHESIS
from engine.texture.expression.placing.generated import Generated
from engine.texture.image import ImageSource
from engine.texture.placed import PlacedInk
from engine.texture.record import pictures_of
from engine.texture.table import TextureError

FORMAT = 6  # of paintings with selections, references, guides, paper, learnt detail or examples without seams
PLACED_FORMAT = 5  # of others with placements, or of the grid of 2^-12
FINE_FORMAT = 4  # of others; 3: packs of the second format; 2: nothing of examples; 1: no colour left to ink
MANIFEST = "inkfall/manifest.json"
MANIFEST_AGAIN = "inkfall/manifest-again.json"  # the same, without its own sum, at the other end of the file
RECORDING = "inkfall/recording.jsonl"
_MOST_NOTES = 20  # lines about bookmarks, guides and the like
_CONSTANTS = {"byteorder": "little", "tile": TILE, "space": "srgb-premultiplied"}
_UNIT = "2^-{}"
Shas = tuple[str | None, ...]  # of a texture's picture, its mask, what was learnt, and its control channels


@dataclass(frozen=True)
class Pack:
    """A member with packed tiles: how many, and their bytes when unpacked."""

    member: str
    tiles: int
    plain: int


@dataclass(frozen=True)
class PictureEntry:
    """A picture that inks or textures refer to."""

    name: str
    sha: str
    size: tuple[int, int]
    packs: tuple[Pack, ...]


@dataclass(frozen=True)
class Manifest:
    """The parsed manifest.  `root` has layers without paint; `packs`: where their paint is, by the layer's id;
    `plots`: what was painted there with `examples`; `members`: (size, SHA-256) of all members but the manifest;
    `pictured`: the layers whose paint is their picture, as what they showed is not there; `notes`: what could not be
    read and is left out, a line each."""

    frame: Rect
    seed: int
    active: str | None
    root: Group
    packs: Mapping[int, tuple[Pack, ...]]
    grounds: Mapping[int, GroundEntry]  # of the layers that began with a picture
    plots: Mapping[int, tuple[PlotEntry, ...]]
    textures: Mapping[str, tuple[str, Map[str, Any], *Shas]]
    examples: Mapping[str, ExampleEntry] = field(default_factory=dict)
    pictures: Mapping[str, PictureEntry] = field(default_factory=dict)
    members: Mapping[str, tuple[int, str]] = field(default_factory=dict)
    texture: int = TEXTURES  # the revision of textures' pixels by which colour was left out
    synthesis: int = SYNTHESIS  # and of what examples grow into
    bookmarks: Bookmarks = field(default_factory=lambda: NO_BOOKMARKS)
    notes: tuple[str, ...] = ()
    arithmetic: int = LIBRARY
    grid: int = FINE
    selections: tuple[SelectionEntry, ...] = ()
    guides: Guides = field(default_factory=lambda: NO_GUIDES)
    paper: str | None = None
    touches: Touches = NO_TOUCHES
    pictured: frozenset[int] = frozenset()

    def textures_with(self, pictures: Mapping[str, ImageSource]) -> Map[str, Texture]:
        """Returns the named textures; FieldError if one cannot be made."""
        made = {}
        for name, (kind, parameters, *shas) in self.textures.items():
            if any(sha is not None and sha not in pictures for sha in shas):
                raise FieldError(f"textures.{name}", "no picture", "one of those in the file")
            source, mask, maps, control = (None if sha is None else replace(pictures[sha], name=name) for sha in shas)
            made[name] = Texture(kind, parameters, source, mask, self.arithmetic, maps, control).lent(pictures)
            plot_files.check_texture(f"textures.{name}", made[name])
            try:
                made[name].instance({}, 0, 0)
            except TextureError as error:
                raise FieldError(f"textures.{name}.{error.place}", error.found, error.expected) from None
        return Map(made)

    def painting(self, root: Group, textures: Map[str, Texture], chosen: Chosen = Chosen()) -> Painting:  # noqa: B008
        """Returns the painting of layers, textures and selections."""
        heaped = selection_files.with_heaps(replace(root, paper=self.paper), chosen.heaps)
        root = selection_files.with_masks(heaped, chosen.masks, self.pictured)
        own = self.frame, self.seed, root, self.active, textures, self.bookmarks, self.arithmetic, self.grid
        return Painting(*own, chosen.selection, chosen.saved, guides=self.guides, touches=self.touches)

    def grown_bytes(self) -> int:
        """Returns what all that was painted with examples takes in memory, about; FieldError if an example cannot
        be."""
        sizes = {sha: entry.size for sha, entry in self.pictures.items()}
        return plot_files.cost(self.examples, (plot for plots in self.plots.values() for plot in plots), sizes)


# ---- writing ----


def manifest_json(
    painting: Painting,
    packs: Mapping[int, list[Pack]],
    laid: Mapping[int, GroundEntry],
    plots: Mapping[int, list[PlotEntry]],
    pictures: list[PictureEntry],
    members: Mapping[str, tuple[int, str]],
    selections: Sequence[SelectionEntry] = (),
) -> dict[str, Any]:
    """Returns the JSON of a painting's manifest."""
    frame = painting.frame
    examples = plot_files.entries(painting.root)
    return {
        "inkfall": format_of(painting),
        "texture": TEXTURES,
        **_CONSTANTS,
        "unit": _UNIT.format(painting.grid),
        **({"grid": painting.grid} if painting.grid != FINE else {}),
        "frame": [frame.x0, frame.y0, frame.width, frame.height],
        "seed": painting.seed,
        **({"paper": painting.paper} if painting.paper is not None else {}),
        **({"arithmetic": painting.arithmetic} if painting.arithmetic != LIBRARY else {}),
        "active": painting.active,
        "layers": [_node_json(node, packs, laid, plots) for node in painting.root.children],
        "textures": {
            name: {
                "kind": t.kind,
                "parameters": thawed(t.parameters),
                **({"picture": t.source.sha} if t.source is not None else {}),
                **{key: one.sha for key, one in t.beside.items()},
            }
            for name, t in sorted(painting.textures.items())
        },
        **({"bookmarks": list(map(write_bookmark, painting.bookmarks.values()))} if painting.bookmarks else {}),
        **({"guides": list(map(write_guide, painting.guides.values()))} if painting.guides else {}),
        **({"touches": write_touches(painting.touches)} if painting.touches else {}),
        **({"synthesis": SYNTHESIS, "examples": plot_files.examples_json(examples)} if examples else {}),
        **selection_files.selections_told(selections, _pack_json),
        "pictures": {
            p.sha: {"name": p.name, "size": list(p.size), "packs": [_pack_json(k) for k in p.packs]} for p in pictures
        },
        "members": {name: list(entry) for name, entry in members.items()},
    }


def format_of(painting: Painting) -> int:
    """Returns the oldest format that knows all that the file of a painting tells."""
    roles = any(written_role(node) or node.clip for node in layers.walk(painting.root))
    chosen = painting.selection is not None or painting.selections or painting.guides or painting.touches
    wrapped = any(layer.wrap is not None or layer.heaps for layer in layers.layers(painting.root))
    masked = any(True for _ in selection_files.masks_of(painting.root))
    inks = held_inks(painting.root)
    newer = any(isinstance(ink, Generated) or len(pictures_of(ink)) > 1 for ink in inks)
    newer = newer or plot_files.controlled(painting)
    if any((roles, wrapped, masked, chosen, newer, painting.paper is not None)):
        return FORMAT
    if painting.grid != FINE or any(True for _ in loops.placements(painting.root)):
        return PLACED_FORMAT
    return PLACED_FORMAT if any(isinstance(ink, PlacedInk) for ink in inks) else FINE_FORMAT


def _pack_json(pack: Pack) -> list[Any]:
    return [pack.member, pack.tiles, pack.plain]


def _node_json(
    node: Node,
    packs: Mapping[int, list[Pack]],
    laid: Mapping[int, GroundEntry],
    plots: Mapping[int, list[PlotEntry]],
) -> dict[str, Any]:
    common = {
        "id": node.id,
        "name": node.name,
        "opacity": node.opacity,
        "visible": node.visible,
        "blend": node.blend,
        "locked": node.locked,
        **({"clip": True} if node.clip else {}),
    }
    common |= written_role(node)
    if isinstance(node, Layer):
        stored = [_pack_json(pack) for pack in packs.get(node.id, [])]
        ground = {"ground": grounds.to_json(laid[node.id])} if node.id in laid else {}
        grown = {"plots": [plot_files.plot_json(plot) for plot in plots[node.id]]} if plots.get(node.id) else {}
        commits = {"commits": node.pyramid.commits} if node.pyramid.grid != FINE else {}
        own = {"alpha_locked": node.alpha_locked, "packs": stored, **commits}
        own |= {} if node.wrap is None else {"wrap": write_part(node.wrap)}
        return {"kind": "layer", **common, **own, **ground, **grown}
    if isinstance(node, Placement):
        return {"kind": "placement", **common, "source": node.of, **write_placing(Placing.told(node))}
    children = [_node_json(child, packs, laid, plots) for child in node.children]
    return {"kind": "group", **common, "isolated": node.isolated, "children": children}


# ---- reading ----


def parse_manifest(value: Any) -> Manifest:
    """Returns the manifest that a JSON value tells.  FieldError names the member; LayerError if the tree cannot be."""
    members = Fields(value, "manifest")
    version = members.integer("inkfall", lo=1, hi=1 << 30)
    if version > FORMAT:
        raise FieldError("manifest.inkfall", f"{version} (a newer Inkfall wrote this)", f"version {FORMAT}")
    for name, expected in _CONSTANTS.items():
        if members.take(name, expected="a value") != expected:
            raise members.fault(name, repr(expected))
    frame = _frame(members)
    held = _Held(read_grid(members) if version > FINE_FORMAT else FINE)
    if members.take("unit", expected="a value") != _UNIT.format(held.grid):
        raise members.fault("unit", repr(_UNIT.format(held.grid)))
    root, lost = _tree(members, held)
    active = members.take("active", None)
    if active is not None and not (isinstance(active, str) and layers.has(root, active)):
        raise members.fault("active", "the name of a layer")
    marked, guides, touches = _beside_layers(members, told_of(lost))
    return Manifest(
        frame,
        members.integer("seed", lo=-SEED_LIMIT, hi=SEED_LIMIT),
        active,
        root,
        held.packs,
        held.grounds,
        held.plots,
        {name: _texture(v, f"textures.{name}") for name, v in _object(members, "textures").items()},
        plot_files.parse_examples(_object(members, "examples")) if "examples" in members else {},
        {sha: _picture(sha, v) for sha, v in _object(members, "pictures").items()},
        {name: _member(v, f"members.{name}") for name, v in _object(members, "members").items()},
        TEXTURES if version < 2 else members.integer("texture", lo=1, hi=1 << 30),
        members.integer("synthesis", SYNTHESIS, lo=1, hi=1 << 30),
        *marked,
        members.integer("arithmetic", LIBRARY, lo=LIBRARY, hi=EVERYWHERE),
        held.grid,
        selection_files.read_selections(members, _packs),
        guides,
        read_paper(members) if version > PLACED_FORMAT else None,
        touches,
        frozenset(one.id for one in lost),
    )


def _tree(members: Fields, held: _Held) -> tuple[Group, tuple[Placement, ...]]:
    """Returns the tree, with layers for those placements that show what is not there, and these."""
    nodes = tuple(_node(v, f"layers[{i}]", held, 0) for i, v in enumerate(_list(members, "layers")))
    root = layers.checked(Group(layers.EMPTY.id, layers.EMPTY.name, children=nodes))
    lost = lost_sources(root)
    held.packs.update((one.id, ()) for one in lost)
    return loops.checked(layers_instead(root, lost, held.grid) if lost else root), lost


def _frame(members: Fields) -> Rect:
    x, y, width, height = members.integers("frame", 4, limit=PLACE_LIMIT)
    if not (1 <= width <= SIDE_LIMIT and 1 <= height <= SIDE_LIMIT):
        raise members.fault("frame", "a width and height from 1 to 2^40")
    return Rect.at(x, y, width, height)


@dataclass(frozen=True)
class _Held:
    """What layers hold, by their ids; `grid`: on which it lies."""

    grid: int
    packs: dict[int, tuple[Pack, ...]] = field(default_factory=dict)
    grounds: dict[int, GroundEntry] = field(default_factory=dict)
    plots: dict[int, tuple[PlotEntry, ...]] = field(default_factory=dict)


def _list(members: Fields, name: str) -> list[Any]:
    value = members.take(name, expected="a list")
    if not isinstance(value, list):
        raise members.fault(name, "a list")
    return value


def _object(members: Fields, name: str) -> dict[str, Any]:
    value = members.take(name, expected="an object")
    if not isinstance(value, dict):
        raise members.fault(name, "an object")
    return value


def _node(value: Any, where: str, held: _Held, depth: int) -> Node:
    members = Fields(value, where)
    kind = members.take("kind", expected='"layer", "group" or "placement"')
    if kind not in ("layer", "group", "placement") or depth > layers.MAX_DEPTH + 1:
        raise members.fault("kind", f'"layer", "group" or "placement", at most {layers.MAX_DEPTH} deep')
    common: dict[str, Any] = {
        "id": members.integer("id", lo=1, hi=1 << 62),
        "name": members.text("name"),
        "opacity": members.number("opacity", lo=0.0, hi=1.0),
        "visible": members.flag("visible"),
        "blend": members.text("blend"),
        "locked": members.flag("locked"),
        "clip": members.flag("clip", False),
    }
    common |= role_kept(members, kind)
    if kind == "layer":
        held.packs[common["id"]] = _packs(members)
        ground = members.take("ground", None)
        if ground is not None:
            held.grounds[common["id"]] = grounds.read_ground(ground, f"{where}.ground")
        plots = _list(members, "plots") if "plots" in members else []
        if plots:
            held.plots[common["id"]] = tuple(
                plot_files.parse_plot(v, f"{where}.plots[{i}]") for i, v in enumerate(plots)
            )
        commits = members.integer("commits", lo=0, hi=1 << 62) if held.grid != FINE else 0
        pyramid = Pyramid(grid=held.grid, commits=commits)
        wrap = read_part(members, "wrap") if "wrap" in members else None
        return Layer(**common, alpha_locked=members.flag("alpha_locked"), pyramid=pyramid, wrap=wrap)
    if kind == "placement":
        of = None if members.take("source", None) is None else members.integer("source", lo=1, hi=1 << 62)
        placing = read_placing(members)
        return Placement(**common, of=of, pose=placing.posed(Pose()), **placing.fields())
    inside = _list(members, "children")
    children = tuple(_node(v, f"{where}.children[{i}]", held, depth + 1) for i, v in enumerate(inside))
    return Group(**common, isolated=members.flag("isolated"), children=children)


def _packs(members: Fields) -> tuple[Pack, ...]:
    out = []
    for entry in _list(members, "packs"):
        sound = isinstance(entry, list) and len(entry) == 3 and isinstance(entry[0], str)
        if not (sound and all(type(v) is int and 0 <= v < 1 << 62 for v in entry[1:])):
            raise members.fault("packs", "[member, tiles, bytes] each")
        out.append(Pack(*entry))
    return tuple(out)


def _texture(value: Any, where: str) -> tuple[str, Map[str, Any], *Shas]:
    members = Fields(value, where)
    shas = tuple(members.text(name, None) for name in ("picture", "mask", "maps", "control"))
    return members.text("kind"), frozen(_object(members, "parameters")), *shas


def _picture(sha: str, value: Any) -> PictureEntry:
    members = Fields(value, f"pictures.{sha[:12]}")
    width, height = members.integers("size", 2, limit=1 << 20)
    if width < 1 or height < 1 or width * height > 1 << 28:
        raise members.fault("size", "a width and height from 1 on, at most 2^28 pixels")
    return PictureEntry(members.text("name"), sha, (width, height), _packs(members))


def _beside_layers(members: Fields, notes: Sequence[str]) -> tuple[tuple[Bookmarks, tuple[str, ...]], Guides, Touches]:
    """Returns what no paint hangs on, as far as it can be read; with the bookmarks, after `notes`, a line for each that
    cannot, not more than anybody reads."""
    guides, left_out = read_guides(members.take("guides", []))
    touches, taken_off = read_touches(members.take("touches", []))
    bookmarks, unmarked = read_bookmarks(members.take("bookmarks", []))
    every = (*notes, *left_out, *taken_off, *unmarked)
    few = every if len(every) <= _MOST_NOTES else (*every[:_MOST_NOTES], f"{len(every) - _MOST_NOTES} more")
    return (bookmarks, few), guides, touches


def _member(value: Any, where: str) -> tuple[int, str]:
    if not (isinstance(value, list) and len(value) == 2 and type(value[0]) is int and isinstance(value[1], str)):
        raise FieldError(where, "another form", "[size, SHA-256]")
    return value[0], value[1]
