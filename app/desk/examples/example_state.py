"""Examples to paint with: those that come along, the artist's own, and what the panel knows of them.

An example is a picture, NAME.png, the region of it that is grown, NAME.mask.png, and NAME.toml, which tells how
(Ritter et al. 2006, section 3).  Where the region was painted here, NAME.region.json tells by which steps, and
NAME.base.png what they began with if that was a mask.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import platformdirs
from immutables import Map

from app.desk.examples import charts
from app.desk.examples.chart_state import ChartState
from app.desk.examples.finding_state import FindingState
from app.desk.examples.following import Following
from app.desk.examples.region_state import RegionState
from engine.brush.checks import frozen
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.files.strict_json import BYTES_CAP, loads
from engine.makers.definitions import defined_by
from engine.painting.commands import DefineTexture
from engine.texture.example.parameters import NEW, Parameters, read_toml, with_values
from engine.texture.record import LEARNT

OWN = "Own"  # the group of the artist's own
HERE = "In this painting"  # the group of those that only the painting has
ALL = ""  # the group of every example
_RANK = {OWN: 0, HERE: 1, "Watercolour": 2, "Paper": 3}  # others follow, by name
MASK, PICTURE, PARAMETERS = ".mask.png", ".png", ".toml"
STEPS, BASE = ".region.json", ".base.png"
PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff")
_SIZES = (-2, -1, 0, 1, 2)  # octaves by which a texture is larger than the canvas pixels seen when it was chosen
_REACH = 8  # levels from a stroke's to that of the example's pixels
TOO_FINE = 4  # levels that a stroke may be coarser: each makes four times the pixels
DEPTHS = (-99, 99)
NOWHERE = Path()  # the files of those that only the painting has
NAME_CAP = 40  # characters
_SETTLE = 0.08  # seconds from one painting of the sample stroke to the next
TABS = ("palette", "region", "maps", "settings")
KIND = "example"  # of textures


@dataclass(frozen=True, slots=True)
class Entry:
    """An example.  `mask_sha`: of the artist's own region as its file is; `steps`: by which it was painted, of
    `engine.strokes.example_region`, on the mask `base`, or on what is not transparent; `here`: the parameters of a
    texture that only the painting has, which has no files; `given`: what its file says it is called."""

    name: str
    group: str
    picture: Path
    mask: Path | None
    parameters: Parameters
    own: bool
    mask_sha: str = ""
    here: Mapping[str, Any] | None = None
    given: str = ""
    steps: tuple[Map[str, Any], ...] = ()
    base: Path | None = None
    maps: Map[str, object] = field(default_factory=Map)  # as its file tells them

    @property
    def ident(self) -> str:
        """Tells this entry from all others of the palette."""
        if self.here is not None:
            return f"here {self.name}"
        return f"{'own' if self.own else 'bundled'} {self.name}"

    @property
    def title(self) -> str:
        """Returns what it is called: `wash-indigo` is a wash, indigo."""
        if self.here is not None or self.given:
            return self.given or self.name
        text = self.name.replace("-", " ").replace("_", " ").strip() or self.name
        return text[:1].upper() + text[1:]


def bundled_folder() -> Path:
    """Returns the examples that come with the program; the folder lies beside the packages."""
    return Path(__file__).resolve().parents[3] / "palettes" / "examples"


def own_folder() -> Path:
    """Tells where the artist's own are kept."""
    return platformdirs.user_data_path("inkfall") / "examples"


def load_examples(folder: Path, own: bool) -> tuple[list[Entry], list[str]]:
    """Returns the examples of a folder by group and name, and a line for each file of parameters, or mask, that is
    none."""
    found, faults = [], []
    pictures = (p for p in folder.glob(f"*{PICTURE}") if not p.name.endswith((MASK, BASE))) if folder.is_dir() else ()
    for path in sorted(pictures):
        names, parameters, maps, fault = _told(path.with_suffix(PARAMETERS))
        faults += [f"{path.stem}{PARAMETERS}: {fault}"] if fault else []
        mask = path.with_name(path.stem + MASK)
        there, sha = mask if mask.is_file() else None, ""
        try:
            sha = mask_sha(mask, mask.stat().st_mtime_ns) if own and there else ""
        except (FileError, OSError) as error:
            faults.append(str(error))
            there = None
        group, title = names.get("group", "Other"), names.get("title", "")
        about = path.stem, OWN if own else group, path, there, parameters, own, sha
        entry = Entry(*about, given=title, maps=charts.absolute(maps, folder) if own else maps)
        found.append(_painted(entry) if sha else entry)
    return arranged(found), faults


def arranged(entries: Iterable[Entry]) -> list[Entry]:
    """By group, in the order in which these are listed, and by name."""
    return sorted(entries, key=lambda e: (_RANK.get(e.group, len(_RANK)), e.group, (e.given or e.name).lower()))


def label(entry: Entry, entries: Iterable[Entry]) -> str:
    """Returns an example's title without a first word that several of its group share: a wash among washes."""
    first, _, rest = entry.title.partition(" ")
    same = sum(other.group == entry.group and other.title.partition(" ")[0] == first for other in entries)
    return rest[:1].upper() + rest[1:] if rest and same > 2 and entry.group not in (OWN, HERE) else entry.title


def _painted(entry: Entry) -> Entry:
    """Returns the example with the steps of its region, if these are what made the mask that is there now."""
    try:
        with open(entry.picture.with_name(entry.name + STEPS), "rb") as file:
            told = loads(file.read(BYTES_CAP))
        if not isinstance(told, dict) or told.get("mask_sha") != entry.mask_sha:
            return entry
        steps = frozen(told.get("steps"))
    except (OSError, ValueError):
        return entry
    base = entry.picture.with_name(entry.name + BASE)
    held = isinstance(steps, tuple) and all(isinstance(step, Map) for step in steps)
    return replace(entry, steps=steps, base=base if told.get("base") is True else None) if held else entry


def _told(path: Path) -> tuple[Mapping[str, str], Parameters, Map[str, object], str]:
    """Returns the names (`group`, `title`), the parameters and the maps in a file, and what is wrong with it."""
    if not path.is_file():
        return {}, NEW, Map(), ""
    try:
        data = path.read_bytes()
        parameters = read_toml(data, NEW)
        told = tomllib.loads(data.decode())
        names: dict[str, str] = {name: told[name] for name in ("group", "title") if name in told}
        maps: Map[str, object] = frozen(told.get("maps", {}))
        return names, parameters, maps, ""
    except (OSError, FieldError) as error:
        return {}, NEW, Map(), str(error)


def within_reach(brush: Brush, level: int) -> bool:
    """Tells whether a stroke at a level may have the size that a brush gives its texture."""
    return brush.example_level is None or -_REACH <= brush.example_level - level <= TOO_FINE


@dataclass(slots=True)
class ExampleState:
    """`chosen`: the entry that is painted with or looked at, by its ident; `size`: one of `_SIZES`; `base`: the level
    that was shown when it was chosen; `eraser`: the depth that the eraser takes away, None for everything; `drafts`: by
    ident, parameters that are being tried; `used`: those that are painted with; `regions`: those that are being
    painted; `spot`: where the region is on the screen, corner and pixels of the screen per pixel of it."""

    entries: tuple[Entry, ...] = ()
    chosen: str = ""
    group: str = ALL
    tab: str = "palette"
    size: int = 0
    base: int = 0
    depth: int = 0
    radius: float = 36.0  # of the brush when it begins to paint with examples, pixels of the screen
    eraser: int | None = None
    swapping: bool = False
    prepared: bool = False  # whether the engine was asked to get ready
    drafts: dict[str, Map[str, Any]] = field(default_factory=dict)
    used: dict[str, Map[str, Any]] = field(default_factory=dict)
    regions: dict[str, RegionState] = field(default_factory=dict)
    finding: FindingState | None = None  # what lies on the ground of one's picture, while it is found
    opening: str = ""  # the entry whose region is being read
    spot: tuple[float, float, float] | None = None
    sampled: tuple[int, int] = (0, 0)  # width and height of the picture of a stroke, framebuffer pixels
    sampling: str = ""  # the entry whose picture of a stroke was asked for last
    seen: str = ""  # and the one whose picture is there
    hung: dict[str, Any] = field(default_factory=dict)  # what thumbnails of those of the painting were asked for
    following: Following = field(default_factory=lambda: Following(_SETTLE))
    follows: bool = True  # the pen, where the example tells which way it runs
    chart: ChartState = field(default_factory=ChartState)  # the map that is painted
    charts: dict[str, Map[str, object]] = field(default_factory=dict)  # by ident, maps other than those of its file

    @property
    def entry(self) -> Entry | None:
        """Gives the entry that is chosen; None if there is none."""
        return next((entry for entry in self.entries if entry.ident == self.chosen), None)

    @property
    def region(self) -> RegionState | None:
        """Returns the region that is being painted."""
        return self.regions.get(self.chosen)

    def groups(self) -> list[str]:
        """Gives the groups of the palette, in its order."""
        return list(dict.fromkeys(entry.group for entry in self.entries))

    def listed(self) -> list[Entry]:
        """Gives the entries of the group that is listed."""
        return [entry for entry in self.entries if self.group in (ALL, entry.group)]

    # --- the region --------------------------------------------------------------------------------------------------

    def over(self, x: float, y: float) -> bool:
        """Tells whether a point of the screen is on the region."""
        if self.spot is None or self.region is None or self.tab not in ("region", "maps"):
            return False
        u, v = self.place(x, y)
        width, height = self.region.scene.size
        return 0.0 <= u < width and 0.0 <= v < height

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Returns a point of the screen in pixels of the example."""
        left, top, scale = self.spot if self.spot is not None else (0.0, 0.0, 1.0)
        return (x - left) / scale, (y - top) / scale

    # --- parameters --------------------------------------------------------------------------------------------------

    def draft(self, entry: Entry) -> Parameters:
        """Returns the parameters that the settings show."""
        return with_values(entry.parameters, self.drafts.get(entry.ident, self.used.get(entry.ident, Map())))

    def set(self, entry: Entry, name: str, value: Any) -> None:
        """Sets another value of one of them."""
        now = asdict(replace(self.draft(entry), **{name: value}))
        own = asdict(entry.parameters)
        self.drafts[entry.ident] = Map({key: told for key, told in now.items() if told != own[key]})

    def reset(self, entry: Entry) -> None:
        """As the example's file has them."""
        self.drafts[entry.ident] = Map()

    def tried(self, entry: Entry) -> bool:
        """Tells whether the settings differ from what is painted with."""
        used = self.used.get(entry.ident, Map())
        return self.drafts.get(entry.ident, used) != used

    def needs(self, entry: Entry, draft: bool = False) -> tuple[str, tuple[DefineTexture, ...]]:
        """Returns the name of its texture, and the definition that it needs if not only the painting has it."""
        if entry.here is not None:
            return entry.name, ()
        command = self.command(entry, draft)
        return command.name, (command,)

    def command(self, entry: Entry, draft: bool = False) -> DefineTexture:
        """Returns the definition of its texture, as it is painted with or as the settings are."""
        usual = self.used.get(entry.ident, Map())
        told = self.drafts.get(entry.ident, usual) if draft else usual
        return definition(entry, told, self.charts.get(entry.ident, entry.maps))

    # --- the brush ---------------------------------------------------------------------------------------------------

    def levels(self) -> dict[str, int]:
        """Returns the members of a brush that tell how large the texture is."""
        return {"example_level": self.base - max(self.size, 0), "example_detail": max(-self.size, 0)}

    def erasing(self, brush: Brush) -> Brush:
        """Returns a brush that erases, of everything or of one depth alone."""
        return replace(brush, depth=None if self.eraser is None else float(self.eraser), example_level=None)

    def at_home(self, brush: Brush) -> Brush:
        """Returns the brush as it paints a small picture at level 0."""
        if not brush.row.grows:
            return brush
        return replace(brush, example_level=-max(self.size, 0))


def definition(entry: Entry, told: Mapping[str, Any], maps: Map[str, object] = Map()) -> DefineTexture:  # noqa: B008
    """Returns the command that makes an example's texture; `told`: parameters other than its own.

    All are told, or a texture of the painting that has others would be taken for this one.
    """
    given: dict[str, Any] = {**asdict(entry.parameters), **told, "detail": LEARNT}
    if maps != (Map() if entry.own else entry.maps):
        given["maps"] = maps
    if not entry.own:
        return DefineTexture(entry.title, KIND, Map(given | {"bundled": entry.name}))
    given["path"] = str(entry.picture)
    if entry.steps:
        given |= {"region": entry.steps, "mask_sha": entry.mask_sha}
        given |= {} if entry.base is None else {"mask": str(entry.base)}
    elif entry.mask is not None:
        given |= {"mask": str(entry.mask), "mask_sha": entry.mask_sha}
    return DefineTexture(entry.title, KIND, Map(given))


def here(definitions: Iterable[tuple[str, str, Mapping[str, Any]]], state: ExampleState) -> list[Entry]:
    """Returns those of a painting's textures (name, kind, parameters) that are examples and none that the palette
    has."""
    found = []
    for name, kind, told in definitions:
        if kind == KIND and not any(_is(entry, told, state) for entry in state.entries if entry.here is None):
            found.append(Entry(name, HERE, NOWHERE, None, NEW, False, here=told))
    return found


def _is(entry: Entry, told: Mapping[str, Any], state: ExampleState) -> bool:
    """Tells whether a texture of a painting is an example of the palette, as it came or as it is painted with."""
    if told.get("path" if entry.own else "bundled") != (str(entry.picture) if entry.own else entry.name):
        return False
    return any(defined_by(one, KIND, told) for one in (definition(entry, Map(), entry.maps), state.command(entry)))


def renamed(text: str, entry: Entry, entries: Iterable[Entry]) -> str:
    """Returns what is typed as another name of the artist's own example, tidied, with a number if another of them
    has it; empty if nothing is left of it."""
    plain = " ".join("".join(c if c.isprintable() else " " for c in text).split())[:NAME_CAP].strip()
    taken = {other.title.lower() for other in entries if other.own and other.ident != entry.ident}
    name, number = plain, 1
    while plain and name.lower() in taken:
        number += 1
        name = f"{plain} {number}"
    return name


def in_painting(entry: Entry, definitions: Iterable[tuple[str, str, Mapping[str, Any]]]) -> list[str]:
    """Returns the names of a painting's textures (name, kind, parameters) that are made of the artist's own example."""
    return [name for name, kind, told in definitions if kind == KIND and told.get("path") == str(entry.picture)]


@lru_cache(maxsize=256)
def mask_sha(path: Path, _changed: int) -> str:
    """Returns what a definition calls the region that a file holds now: with another region it defines another texture.
    FileError if it is no picture.  `_changed`: when the file was, in nanoseconds."""
    from engine.strokes.example_files import read_mask  # here: it loads much that the window's start need not wait for

    return sha_of(read_mask(path))


def sha_of(inside: np.ndarray) -> str:
    """Returns what a definition calls a region, bool (h, w)."""
    from engine.texture.image import ImageSource

    return ImageSource.of("", np.repeat(inside[None].astype(np.float32), 4, axis=0)).sha
