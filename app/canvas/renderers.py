"""Whether the processor fills the pixels, too: then what each of them costs is seen."""

from __future__ import annotations

# What software renderers call themselves.
_SOFTWARE = "llvmpipe", "softpipe", "swrast", "SwiftShader", "Software R", "Basic Render Driver", "GDI Generic"


def fills_pixels(renderer: str) -> bool:
    """Tells whether a renderer is one whose pixels the processor fills."""
    return any(name in renderer for name in _SOFTWARE)
