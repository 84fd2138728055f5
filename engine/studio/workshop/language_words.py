"""All that a written texture can say, as the workshop's list of words tells it."""

from __future__ import annotations

from engine.makers.namesakes import bundled_inks, bundled_pictures
from engine.studio.workshop.workshop_records import WorkshopWord, WorkshopWords
from engine.texture.expression.arithmetic_words import FUNCTIONS_OF_NUMBERS
from engine.texture.expression.language import FUNCTIONS
from engine.texture.expression.library.bundled_texts import written_library
from engine.texture.expression.written import PICK, PLACE_NAMES, SLIDER
from engine.texture.table import KINDS

_SETTERS = (
    WorkshopWord(SLIDER, "slider(usual, least, most)", "a number that whoever uses the texture may set"),
    WorkshopWord(PICK, "pick(#rrggbb)", "a colour that whoever uses the texture may set"),
)
_INK, _PICTURE = "the ink of a brush", "the picture of an example"


def language_words() -> WorkshopWords:
    """Returns all words of the language, what makes pictures first, and all textures that have names in it."""
    rows = []
    for name, row in sorted(FUNCTIONS.items(), key=lambda pair: pair[0] in FUNCTIONS_OF_NUMBERS):
        form, _, about = row[3].partition(": ")
        rows.append(WorkshopWord(name, form, about))
    names = tuple(WorkshopWord(name, name, about) for name, about in PLACE_NAMES.items())
    return WorkshopWords((*rows, *_SETTERS), names, _textures())


def _textures() -> tuple[WorkshopWord, ...]:
    kinds = {kind.name: kind.tooltip for kind in KINDS.values() if kind.parameters and not kind.pictured}
    written = {name: text.about for name, text in written_library().items()}
    found = dict.fromkeys(bundled_pictures(), _PICTURE) | dict.fromkeys(bundled_inks(), _INK) | kinds | written
    return tuple(WorkshopWord(name, f'"{name}"(x, y)', found[name]) for name in sorted(found))
