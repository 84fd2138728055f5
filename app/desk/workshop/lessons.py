"""Texts that teach the language of written textures, one step after another; the last ones are things to paint with."""

from __future__ import annotations

from typing import NamedTuple


class Lesson(NamedTuple):
    """`text`: of which comments tell what to look at."""

    title: str
    text: str


FIRST_TEXT = """\
// Each line has a name; the last one is the texture.
// Its picture stands beside it: click there to look at it alone.
grain = fbm(x*4, y*4)
strength = slider(0.6, 0, 1)
ramp(grain * strength, #20140c, #8a5a30, #f0d8a0)
"""

LESSONS = (
    Lesson("1  A number is a grey", "// 0 is black, 1 is white, for each place. x goes to the right.\nfract(x)\n"),
    Lesson(
        "2  Names, and noise",
        "// Multiply x and y, and there is more of it.\nhills = noise(x*3, y*3)\nfine = noise(x*24, y*24)\n"
        "hills*0.7 + fine*0.3\n",
    ),
    Lesson(
        "3  Noise of all sizes",
        "// fbm is noise, finer and finer: zoom in with the wheel over the picture.\nfbm(x*2, y*2)\n",
    ),
    Lesson(
        "4  Colours",
        "// A ramp gives colours to numbers: a place from 0 to 1, then its colour, and so on.\nheight = fbm(x*2, y*2)\n"
        "ramp(height, 0, #1c2c3c, 0.45, #3f6f5a, 0.55, #d8c890, 1, #ffffff)\n",
    ),
    Lesson(
        "5  Sliders",
        "// A slider and a pick are set on the right, by whoever has the texture.\n"
        "rough = slider(0.5, 0, 1)\nstone = pick(#9a8f80)\n"
        "stone * (1 - rough + rough*fbm(x*6, y*6))\n",
    ),
    Lesson(
        "6  Patterns",
        "// A pattern is 1 within, 0 in the gaps.\nwall = bricks(x*4, y*8, 0.1)\nmix(#c8c0b0, #9a4a34, wall)\n",
    ),
    Lesson(
        "7  Each brick another colour",
        "// bricks_random is a number for each brick.\nwall = bricks(x*4, y*8, 0.1)\n"
        "kiln = ramp(bricks_random(x*4, y*8), #7a3224, #b8603c, #c88a5a)\nmix(#c8c0b0, kiln, wall)\n",
    ),
    Lesson(
        "8  Choices and edges",
        "// smoothstep goes softly from 0 to 1, a comparison at once.\nwater = fbm(x*2, y*2)\n"
        "shore = smoothstep(0.44, 0.5, water)\nmix(#20506a, #b8a878 if water < 0.55 else #4a6a34, shore)\n",
    ),
    Lesson(
        "9  Shapes",
        "// A shape is a distance, below 0 within. fill makes it white, outline draws its edge.\n"
        "moon = cut(circle(fract(x) - 0.5, fract(y) - 0.5, 0.35), circle(fract(x) - 0.35, fract(y) - 0.45, 0.3))\n"
        "mix(#101828, #f0e8c8, fill(moon))\n",
    ),
    Lesson(
        "10  Scattered things",
        "// repeat shows a line in each part of a grid, where random(1), random(2) are its own numbers.\n"
        "spot = fill(circle(x - 0.4*(random(1) - 0.5), y - 0.4*(random(2) - 0.5), 0.05 + 0.2*random(3)))\n"
        "many = repeat(spot, 4, 4)\nmix(#2c3a30, #e0d060, many)\n",
    ),
    Lesson(
        "11  Bent",
        "// warp shows a texture a little elsewhere: here stripes run like wood.\n"
        "lines = stripes(y*12, 0.5)\nbent = warp(lines, 0, 0.15*noise(x*2, y*4))\n"
        "mix(#a8743c, #8a5a2a, bent*(0.5 + 0.5*fbm(x*2, y*30)))\n",
    ),
    Lesson(
        "12  Light on a relief",
        "// relief lights heights; what is level gives 0.5.\nheight = noise(x*5, y*5) + 0.3*noise(x*11, y*11)\n"
        "light = relief(height, 315, 0.12)\n#b09a7c * (0.4 + 1.2*light)\n",
    ),
)
