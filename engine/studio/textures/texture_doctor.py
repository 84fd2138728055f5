"""The texture doctor at work: a picture is examined piece by piece while nothing else waits."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from engine.checks.field_error import FieldError
from engine.checks.owned import Owned
from engine.files.fault import FileError
from engine.makers.doctor.examining import Report, Trial, examined
from engine.makers.doctor.trying import TRIED
from engine.makers.lewis import opaque_or_not
from engine.numeric.colour import to_rgba8
from engine.painting.capture import read_picture
from engine.studio import faults, results
from engine.studio.easel import Easel
from engine.studio.textures import structure_ready
from engine.studio.textures import texture_requests as tq
from engine.studio.textures import texture_results as tr
from engine.studio.textures.taken_beside import taken_beside


class TextureDoctor(Owned):
    """It belongs to the engine's thread.  A newer picture takes the place of an older one."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._work: Iterator[tr.DoctorScene | None] | None = None
        self.handlers: dict[type, Callable[[Any], None]] = {tq.DoctorAsk: self._ask}

    @property
    def pending(self) -> bool:
        """Tells whether there is something left to find out, and may be now."""
        return self._work is not None and self._easel.live is None

    def step(self) -> None:
        """Does the next piece of work; sends what is known when that is more."""
        assert self._work is not None
        work, self._work = self._work, None
        found = next(work, self)
        if found is not self:
            self._work = work
        if isinstance(found, tr.DoctorScene):
            self._easel.send(found)

    def _ask(self, request: tq.DoctorAsk) -> None:
        self._work = self._examining(request.path, request.flat) if request.path else None

    def _examining(self, path: str, flat: bool) -> Iterator[tr.DoctorScene | None]:
        yield tr.DoctorScene(path)
        try:
            planes = opaque_or_not(read_picture(path, None))
            for _ in structure_ready.waiting(0.0):
                yield None
            tried = 0
            for report in taken_beside(examined(planes, flat=flat)):
                if report is None:
                    yield None
                    continue
                if not report.trials:
                    self._show("example", report.example)
                for trial in report.trials[tried:]:
                    if trial.colours is not None:
                        self._show(trial.way, trial.colours)
                tried = len(report.trials)
                yield _scene(path, report)
        except (FieldError, FileError) as error:
            yield tr.DoctorScene(path, fault=str(error))
        except Exception as error:
            self._easel.send(tr.DoctorScene(path, fault=faults.words(error)))
            raise

    def _show(self, name: str, colours: np.ndarray) -> None:
        side = min(colours.shape[1:])
        planes = np.ones((4, side, side), np.float32)
        planes[: max(len(colours), 3)] = colours[:, :side, :side]
        pixels = to_rgba8(planes)
        pixels[..., :3] = (planes[:3].transpose(1, 2, 0) * np.float32(255) + np.float32(0.5)).astype(np.uint8)
        self._easel.send(results.Picture(f"doctor {name}", results.frozen(pixels)))


def _scene(path: str, report: Report) -> tr.DoctorScene:
    found = report.gradients
    trials = tuple(map(_told, report.trials))
    return tr.DoctorScene(path, report.kinds, found.light, found.slant, trials, report.advice, report.why)


def _told(trial: Trial) -> tr.DoctorTrial:
    title, found = TRIED[trial.way].title, trial.likeness
    if found is None:
        return tr.DoctorTrial(trial.way, title, 0.0, 0.0, trial.seconds, trial.fault)
    return tr.DoctorTrial(trial.way, title, found.apart, found.copied, trial.seconds)
