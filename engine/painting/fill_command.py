"""The command that fills: a region of like colour, with anything that a brush can do."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from immutables import Map

from engine.brush import settings
from engine.brush.checks import thawed
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields
from engine.numeric.address import Rect
from engine.painting.layering.onto_member import ONTO_PAINT, read_onto
from engine.painting.layering.placing_members import Same
from engine.painting.places import LEVEL_LIMIT, PLACE_LIMIT
from engine.painting.points import plain, points_array

WIDEST_GAP = 1024  # px
WIDEST_GROWN = 256.0  # px
LOOKED_AT_CAP = 1 << 24  # pixels in which a region is looked for
TOLERANCE = 0.1
REGIONS = "alike", "empty", "all", "line"  # within a line, that are meant
_NOTHING: Map[str, Any] = Map()


@dataclass(frozen=True, slots=True)
class Like:
    """The pixels like the one `at` a place of `level`: of those of `rect` (None: of the frame) that differ by
    `tolerance` at most, 0..1, in every premultiplied channel; `contiguous`: only those that hang together with it,
    where gaps of up to `gap` pixels count as closed.

    `of`: the name of what is looked at, None for all that is seen, SAME for the active layer.

    `within`: the corners of a closed line, in pixels from `at`: of what it goes round, all regions that hang together
    with nothing outside of it, by `regions`: "alike", of the colour at `at`; "empty", of none; "all", lines too;
    or "line": all of what it goes round.
    """

    at: tuple[int, int]
    level: int = 0
    rect: Rect | None = None
    tolerance: float = TOLERANCE
    gap: int = 0
    contiguous: bool = True
    of: str | Same | None = Same.SAME
    within: tuple[tuple[float, float], ...] | None = None
    regions: str = "alike"

    @property
    def looked_at(self) -> Rect | None:
        """Gives the pixels in which it is looked for; None for those of the frame."""
        if self.within is None:
            return self.rect
        xs, ys = zip((0.0, 0.0), *self.within, strict=True)
        x, y = self.at
        low, high = (math.floor(min(xs)), math.floor(min(ys))), (math.ceil(max(xs)), math.ceil(max(ys)))
        return Rect(x + low[0] - 1, y + low[1] - 1, x + high[0] + 2, y + high[1] + 2)


@dataclass(frozen=True, slots=True)
class Fill:
    """Fills a region, or (without `like`) what is selected, or the `whole` layer where it has paint, at `level`, with a
    brush, on a layer (None: the active one), or `onto` its mask.  `open`: even if the region reaches the border of
    where it is looked for.  `grow`: pixels by which the region of `like` goes beyond its rim, but not beyond the line
    that it lies within."""

    brush: Brush
    like: Like | None = None
    open: bool = False
    layer: str | None = None
    level: int = 0
    extra: Map[str, Any] = _NOTHING
    onto: str = ONTO_PAINT
    whole: bool = False
    grow: float = 0.0


def place_of(fill: Fill) -> tuple[int, Rect | None]:
    """Returns the level at which a fill is done, and where its region is looked for, if it says so."""
    return (fill.level, None) if fill.like is None else (fill.like.level, fill.like.looked_at)


def read_like(members: Fields, name: str) -> Like:
    """Returns what the member of that name tells of a region."""
    about = Fields(members.take(name), members.at(name))
    level = about.integer("level", 0, lo=-LEVEL_LIMIT, hi=LEVEL_LIMIT)
    x, y = about.integers("at", 2, limit=PLACE_LIMIT)
    rect = None
    if about.take("rect", None) is not None:
        left, top, width, height = about.integers("rect", 4, limit=PLACE_LIMIT)
        if width < 1 or height < 1 or width * height > LOOKED_AT_CAP:
            raise about.fault("rect", f"[X, Y, W, H], W and H at least 1, and at most {LOOKED_AT_CAP} pixels")
        rect = Rect.at(left, top, width, height)
    within = _read_within(about) if about.take("within", None) is not None else None
    if within is not None and rect is not None:
        raise FieldError(about.place, "rect and within", "at most one of them")
    regions = about.take("regions", REGIONS[0])
    if regions not in REGIONS or (within is None and regions != REGIONS[0]):
        raise about.fault("regions", " or ".join(f'"{known}"' for known in REGIONS) + ', with "within"')
    of: str | Same | None = Same.SAME
    if "of" in about:
        of = None if about.take("of") is None else about.text("of")
    return Like(
        (x, y),
        level,
        rect,
        about.number("tolerance", TOLERANCE, lo=0.0, hi=1.0),
        about.integer("gap", 0, lo=0, hi=WIDEST_GAP),
        about.flag("contiguous", True),
        of,
        within,
        regions,
    )


def _read_within(about: Fields) -> tuple[tuple[float, float], ...]:
    """Returns the corners of a line, in pixels."""
    points = points_array(about.take("within"), about.at("within"))
    if len(points) < 3:
        raise about.fault("within", "a list of 3 points or more")
    return tuple((float(x), float(y)) for x, y in points[:, :2].tolist())


def write_like(like: Like) -> dict[str, Any]:
    """Returns the object that `read_like` makes the same of; defaults are left out."""
    out: dict[str, Any] = {"at": list(like.at), "level": like.level}
    if like.rect is not None:
        out["rect"] = [like.rect.x0, like.rect.y0, like.rect.width, like.rect.height]
    if like.tolerance != TOLERANCE:
        out["tolerance"] = plain(like.tolerance)
    if like.gap:
        out["gap"] = like.gap
    if not like.contiguous:
        out["contiguous"] = False
    if not isinstance(like.of, Same):
        out["of"] = like.of
    if like.within is not None:
        out["within"] = [[plain(x), plain(y)] for x, y in like.within]
    if like.regions != REGIONS[0]:
        out["regions"] = like.regions
    return out


def read_fill(members: Fields) -> Fill:
    """Returns the command that fills."""
    like = None if members.take("like", None) is None else read_like(members, "like")
    whole = members.flag("whole", False)
    if whole and like is not None:
        raise members.fault("whole", "false beside like")
    grow = members.number("grow", 0.0, lo=0.0, hi=WIDEST_GROWN)
    if grow and (like is None or like.regions == "line"):
        raise members.fault("grow", '0 but beside like, and beside regions "line"')
    return Fill(
        settings.from_json(members.take("brush", {}), members.at("brush")),
        like,
        members.flag("open", False),
        None if members.take("layer", None) is None else members.text("layer"),
        members.integer("level", 0, lo=-LEVEL_LIMIT, hi=LEVEL_LIMIT) if like is None else 0,
        onto=read_onto(members),
        whole=whole,
        grow=grow,
        extra=members.rest(),
    )


def write_fill(fill: Fill) -> dict[str, Any]:
    """Returns the members of the command."""
    out: dict[str, Any] = {"brush": settings.to_json(fill.brush)}
    if fill.like is not None:
        out["like"] = write_like(fill.like)
    elif fill.level:
        out["level"] = fill.level
    if fill.open:
        out["open"] = True
    if fill.layer is not None:
        out["layer"] = fill.layer
    if fill.whole:
        out["whole"] = True
    if fill.onto:
        out["onto"] = fill.onto
    if fill.grow:
        out["grow"] = plain(fill.grow)
    return {**out, **thawed(fill.extra)}
