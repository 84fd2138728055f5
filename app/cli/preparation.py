"""All brushes made ready by hand: for `app/start`, packagers and containers."""

from __future__ import annotations

from app.cli.outcome import Failed
from app.cli.progress import Progress
from app.desk import presets
from engine.studio.preparing.job_queue import PLAIN_PAINT, expected
from engine.studio.preparing.processes import Preparing
from engine.studio.requests import Swatch

_PICTURE = (104, 44)
_LOOK = 0.5  # seconds from one look at what is done to the next


def prepare() -> str:
    """Compiles the kernels of all bundled brushes that are not in the cache; a line that says so.

    Failed if some could not be made ready, or nothing can be kept.
    """
    found, _ = presets.load_brushes(presets.bundled_folder())
    jobs = expected(Swatch("", preset.brush, _PICTURE, textures=preset.textures) for preset in found)
    faults: list[str] = []
    preparing = Preparing(report=faults.append, gently=False)
    try:
        preparing.want(PLAIN_PAINT, soon=True)
        preparing.want(jobs)
        with Progress("preparing brushes", len(jobs)) as tell:
            while preparing.busy:
                tell(sum(map(preparing.ready, jobs)))
                preparing.wait(_LOOK)
        left = sum(not preparing.done(job) for job in jobs)
    finally:
        preparing.close()
    if left:
        reason = faults[0].strip().splitlines()[-1] if faults else "the folder of kernels cannot be written to"
        raise Failed(f"{left} of {len(jobs)} brushes are not ready ({reason}); they will be as they are painted with")
    return "all brushes are ready"
