"""All that a written texture can say, as the workshop's list of words tells it."""

from __future__ import annotations

from engine.makers.namesakes import texture_names
from engine.studio.workshop.workshop_records import WorkshopWord, WorkshopWords
from engine.texture.expression.arithmetic_words import FUNCTIONS_OF_NUMBERS
from engine.texture.expression.language import FUNCTIONS
from engine.texture.expression.written import PICK, PLACE_NAMES, SLIDER

_SETTERS = (
    WorkshopWord(SLIDER, "slider(usual, least, most)", "a number that whoever uses the texture may set"),
    WorkshopWord(PICK, "pick(#rrggbb)", "a colour that whoever uses the texture may set"),
)


def language_words() -> WorkshopWords:
    """Returns all words of the language, what makes pictures first, and all textures that have names in it."""
    rows = []
    for name, row in sorted(FUNCTIONS.items(), key=lambda pair: pair[0] in FUNCTIONS_OF_NUMBERS):
        form, _, about = row[3].partition(": ")
        rows.append(WorkshopWord(name, form, about))
    names = tuple(WorkshopWord(name, name, about) for name, about in PLACE_NAMES.items())
    textures = tuple(WorkshopWord(name, f'"{name}"(x, y)', about) for name, about in texture_names({}))
    return WorkshopWords((*rows, *_SETTERS), names, textures)
