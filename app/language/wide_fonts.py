"""Fonts with the letters of Japanese and Chinese, which the window's own has not: one of the system's, else a small one
that comes along, with the letters of the catalogue alone."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

from imgui_bundle import imgui

from app.language.words import CATALOGUES

# Files, best first, and which face of the file each language has.
_BOTH = ("NotoSansCJK-Regular.ttc", "NotoSansCJK-VF.otf.ttc", "SourceHanSans.ttc", "DroidSansFallbackFull.ttf")
_FONTS = {
    "ja": (
        *("NotoSansCJKjp-Regular.otf", "NotoSansJP-Regular.ttf", "NotoSansJP-Regular.otf", "NotoSansJP-VF.ttf"),
        *("ipagp.ttf", "ipag.ttf", "TakaoPGothic.ttf", "vlgothic.ttf", "YuGothM.ttc", "meiryo.ttc", "msgothic.ttc"),
        *("ヒラギノ角ゴシック W3.ttc", "Hiragino Sans GB.ttc", *_BOTH),
    ),
    "zh_CN": (
        *("NotoSansCJKsc-Regular.otf", "NotoSansSC-Regular.ttf", "NotoSansSC-Regular.otf", "NotoSansSC-VF.ttf"),
        *("wqy-microhei.ttc", "wqy-zenhei.ttc", "msyh.ttc", "simsun.ttc", "PingFang.ttc", "Hiragino Sans GB.ttc"),
        *_BOTH,
    ),
}
_FACES = {"ja": 0, "zh_CN": 2}  # of Noto's and Adobe's collections
_COLLECTIONS = _BOTH[:3]
_SIZE = 20.0  # points at which their letters are as large as the window's own at 15
_loaded: set[str] = set()


def wide_font(code: str) -> Path | None:
    """Returns the file of a font for a language that needs another one than the window's; None for others, and where
    none is found.  It looks through folders."""
    if code not in _FONTS:
        return None
    bundled = CATALOGUES / f"NotoSansCJK-{code}.otf"
    return _found(_FONTS[code]) or (bundled if bundled.exists() else None)


def load_wide_font(code: str, font: Path | None) -> bool:
    """Has the window's font show a language, too; False where it needs a font and there is none."""
    if code not in _FONTS or code in _loaded:
        return True
    if font is None:
        return False
    told = imgui.ImFontConfig()
    told.merge_mode = True
    told.font_no = _FACES[code] if font.name in _COLLECTIONS else 0
    imgui.get_io().fonts.add_font_from_file_ttf(str(font), _SIZE, told)
    _loaded.add(code)
    return True


def load_language_names() -> None:
    """Has the window's font show what languages call themselves, whichever it speaks."""
    told = imgui.ImFontConfig()
    told.merge_mode = True
    imgui.get_io().fonts.add_font_from_file_ttf(str(CATALOGUES / "NotoSansCJK-names.otf"), _SIZE, told)


def _found(names: tuple[str, ...]) -> Path | None:
    """Returns the first of some files that is among the system's fonts."""
    there = {path.name: path for path in _files() if path.name in names}
    return next((there[name] for name in names if name in there), None)


def _files() -> Iterator[Path]:
    home = Path.home()
    folders = [home / ".local/share/fonts", home / ".fonts", Path("/usr/local/share/fonts"), Path("/usr/share/fonts")]
    if sys.platform == "win32":
        folders = [Path(os.environ.get("WINDIR", "C:/Windows")) / "Fonts"]
    elif sys.platform == "darwin":
        folders = [home / "Library/Fonts", Path("/Library/Fonts"), Path("/System/Library/Fonts")]
    for folder in folders:
        for root, _, names in os.walk(folder):
            yield from (Path(root) / name for name in names)
