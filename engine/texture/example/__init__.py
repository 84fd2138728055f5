"""Painting with example textures (Ritter, Li, Curless, Agrawala & Salesin 2006, "Painting With Texture").

`parameters`: how an example is used; `exemplar`: an analysed example; `region`: what is painted with one, refined from
coarse to fine: in windows of a level (`window`) pixels begin with what the coarser one gives (`starts`) and are
corrected in any order (`correction`) by `rules`; without seams from `pieces` that fit, and where strokes are `narrow`
as if they were wider; `scanline`: the paper's own method, for reference; `show`: the pixels of a region.
"""

SYNTHESIS = 2  # to be counted up when a region of the same pixels, example and seed comes to look otherwise
