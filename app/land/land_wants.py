"""What the window asks of land: the tiles it lacks, the height of the ground, a picture once the eye rests."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Protocol

from app.desk.desk import Desk, Hear
from app.desk.land.land_above import follow_canvas
from app.desk.land.land_state import first_eye
from engine.studio import results
from engine.studio.land.land_records import AskGround, AskLand, AskStill, GroundFound, LandMade, StillCome
from engine.terrain.seen.choosing import FINEST, choose_tiles
from engine.terrain.seen.eye import Eye, place_kept
from engine.terrain.seen.land_tiles import TileKey

ASKED_AT_ONCE = 48  # tiles that are asked for at a time
RESTS_AFTER = 0.25  # seconds without a move after which the picture at rest is asked for
_FOLLOWS = 0.1  # seconds after which the canvas follows what is seen of the land: a ray a frame would be dear
_WIDE = 1.0  # of the window's width, of the land that is seen in the middle at first


class Begins(Protocol):
    """What fills pixels."""

    def begin(self, desk: Desk, now: float) -> None:
        """Begins with those of the land."""
        ...


class LandWants:
    """All calls from the window's thread."""

    def __init__(self) -> None:
        self._asked: tuple[object, ...] = ()
        self._still: tuple[object, ...] = ()
        self._serial: int | None = None
        self._followed, self._behind = -_FOLLOWS, False
        self._lacking: list[TileKey] = []
        self._chosen = False  # whether tiles were, that are not asked for yet
        self.hears: dict[type, Hear] = {
            LandMade: _made,
            GroundFound: self._ground,
            StillCome: _still,
            results.Scene: self._scene,
        }

    def sees(self, desk: Desk) -> None:
        """Chooses the tiles of the next picture, if that is to be another one."""
        state = desk.land
        left, top, right, bottom = (round(inset) for inset in desk.insets)
        room = left, top, max(1, desk.view.width - left - right), max(1, desk.view.height - top - bottom)
        if room != state.room:
            state.room, state.changed, state.still = room, True, None
        if desk.known.scene is not None and desk.known.scene.frame != state.frame:
            state.frame, state.changed = desk.known.scene.frame, True
        if state.eye is not None and state.changed:
            found = choose_tiles(state.sight(), {key: kept.tile for key, kept in state.kept.items()})
            state.drawn, state.lacking = found.drawn, len(found.lacking)
            state.use(found.wanted)
            self._lacking = found.lacking[:ASKED_AT_ONCE]
            self._behind = self._chosen = True

    def begin(self, desk: Desk, now: float, drawing: Begins) -> None:
        """Has the land's pixels filled beside what comes next; while one paints, the newest tile is still to come."""
        if desk.land.on and desk.known.ready and not desk.painting:
            self.sees(desk)
            drawing.begin(desk, now)

    def wants(self, desk: Desk, now: float) -> None:
        """Posts what is lacking."""
        state = desk.land
        if not state.on:
            if self._asked:
                self._asked = self._still = ()
                desk.post(AskLand(()))
                desk.post(AskStill(state.number))
                state.forget()
            return
        self.sees(desk)
        if state.eye is None:
            self._place(desk)
            return
        if self._chosen:
            self._chosen = False
            self._ask(desk)
        if self._behind and not desk.painting and now - self._followed >= _FOLLOWS:
            self._followed, self._behind = now, False
            follow_canvas(desk)
        self._rest(desk, now)

    def _place(self, desk: Desk) -> None:
        """Asks how high the ground is that lies in the middle of the canvas."""
        state = desk.land
        if state.asked is None:
            place, stands = desk.view.to_canvas(*desk.middle()), state.stands
            by = 1 << place.exponent
            ask = AskGround(Fraction(place.x, by), Fraction(place.y, by), desk.view.shown_level)
            if stands is not None:
                ask = AskGround(*stands.place(), stands.level)
            state.asked = ask
            self._asked = (ask,)
            desk.post(ask)

    def _ask(self, desk: Desk) -> None:
        kept = desk.land.kept
        asked = *((key, -1) for key in self._lacking), *((key, kept[key].revision) for key in desk.land.drawn)
        if asked != self._asked:
            self._asked = asked
            desk.post(AskLand(asked))

    def _rest(self, desk: Desk, now: float) -> None:
        state = desk.land
        key = (state.eye, state.size, max((kept.revision for kept in state.kept.values()), default=0))
        if self._still and self._still != key:
            self._still = ()
            state.number += 1
            desk.post(AskStill(state.number))
        if (
            not self._still
            and not state.lacking
            and not state.goal
            and now - state.moved > RESTS_AFTER
            and not desk.painting
        ):
            self._still = key
            state.number += 1
            desk.post(AskStill(state.number, state.eye, state.clear, state.size))

    def _ground(self, desk: Desk, found: GroundFound, now: float) -> None:
        state = desk.land
        if found.asked is not state.asked or not state.on:
            return
        stands, state.stands = state.stands, None
        if stands is not None:
            state.clear = math.ldexp(stands.height, -stands.level)
            x, y = (place_kept(place) for place in stands.place())
            state.look(Eye(x, y, found.z + state.clear, stands.turn % 360.0, stands.tilt, stands.fov), now)
            return
        view = desk.view
        wide = _WIDE * state.size[0] / view.scale(0)
        if view.shown_level > FINEST:
            wide = math.ldexp(float(state.size[0]), -FINEST)
            desk.say(f"The land is seen down to level {FINEST}")
        turn = -view.angle * 57.29577951308232
        state.clear = 0.4 * wide
        state.eye = None
        state.look(first_eye(found.asked.x, found.asked.y, found.z, wide, turn), now)
        assert state.eye is not None
        state.clear = max(1e-9, state.eye.z - found.z)

    def _scene(self, desk: Desk, scene: results.Scene, _now: float) -> None:
        """Another painting is shown."""
        if scene.serial != self._serial:
            self._serial = scene.serial
            desk.land.forget()


def _made(desk: Desk, made: LandMade, now: float) -> None:
    if desk.land.on:
        desk.land.take(made.tile, made.revision, now)


def _still(desk: Desk, still: StillCome, _now: float) -> None:
    if desk.land.on and still.number == desk.land.number:
        desk.land.still = still
