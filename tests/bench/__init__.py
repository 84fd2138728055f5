"""Benchmarks: each measures a figure and, in the same run, the bound that it is compared with.

A benchmark is a module here with `measure(small) -> Iterable[Figure | Skipped]`, and a row in BENCHES.  `small`: only
to see that it runs, on the least work there is; its ratios mean nothing.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Figure:
    """One row: `value` in `unit`; `ratio` of it to the bound measured in the same run, which ought to be at most
    `limit` (or at least, where `more_is_better`).  `note`: how the bound came about, where its name does not tell."""

    name: str
    value: float
    unit: str
    bound: str
    ratio: float
    limit: float
    more_is_better: bool = False
    note: str = ""

    @property
    def within(self) -> bool:
        return self.ratio >= self.limit if self.more_is_better else self.ratio <= self.limit


@dataclass(frozen=True, slots=True)
class Skipped:
    """A row that cannot be measured here, and why."""

    name: str
    reason: str


# Name, what it measures.  The module bench.<name> does it.
BENCHES = {
    "casting": "rays over land, and a picture of it with shadows, against its rays one by one from the eye",
    "view": "a 1920 x 1080 view from its parent level, against copying the bytes that it moves",
    "dab": "soft dabs into the coverage of a stroke, and through texture into pixels",
    "place": "placements at 1920 x 1080 beside their source, and pictures that contain themselves",
    "raster": "a soft dab of each raster-op through texture into pixels, against copying its bytes",
    "spectral": "a painted spectrum to its preview, and the endless field of sparse convolution",
    "written": "ten lines of a written texture with two noises of six octaves; from a text to its picture",
    "matching": "a texture matched to an example, 256 to 256 and to 512, against peers and against its transforms",
    "structured": "textures with a structure: their yardstick, what is copied, seconds at 256 x 256",
    "masks": "masks found by themselves on twenty composites: overlap, error of alpha, seconds of a correction",
    "learnt": "detail below a picture's own pixels: against the true octave, codes and expansion; ns a pixel",
    "example": "painting with example textures: preview, refinement, threads, and G'MIC's synthesis",
    "seams": "examples grown without seams: rims, repeats of level strokes, narrow strokes, against the method before",
    "stroke": "a stroke of 1,000 points, 10,000 px over 2000 x 2000, to pixels at all levels; beside libmypaint",
    "copies": "a stroke drawn sixteen times in one step, against the same sixteen strokes",
    "flooding": "the region of like colour that a pixel lies in, with and without gaps closed, beside labelling it",
    "selecting": "a stroke where something is selected, against the same where nothing is",
    "looking": "four layers of 4000 x 4000 seen at three zooms, panned by a column, and zoomed into, engine alone",
    "zoom": "a continuous zoom through 40 levels at 1280 x 800: the engine's work, and the frames of a real window",
    "frames": "the frames of a real window that pans",
    "latency": "a movement of the pen until its paint is on the screen, through the X server",
    "filming": "a flight through 12 levels at 1920 x 1080, against libx264 on the same frames",
    "pyramids": "a Zarr pyramid by a Dask cluster of two processes, against one process",
    "files": "saving and opening four layers of 4000 x 4000",
    "exporting": "a picture of 33 megapixels of four layers as a PNG, against deflating its rows alone",
    "start": "from the command to the first frame of the window",
    "first_start": "with no kernel compiled: to the first dab, and to all brushes",
    "playing": "a recording of the gallery replayed, against its commands applied one after the other",
    "past": "small pictures of steps on random layers; which of 5,000 strokes show at a pixel; a look at a packed step",
    "memory": "what the process and its history hold after 1,000 strokes",
}
