"""Files of settings that the program writes for itself: one JSON object each, whole or not at all."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from engine.checks.field_error import FieldError
from engine.checks.values import described
from engine.files import strict_json
from engine.files.atomic import replacing

KeptObject = dict[str, object]  # an object of a file
Kept = TypeVar("Kept")
_BYTES_CAP = 1 << 20


def read_kept_object(path: Path, read: Callable[[KeptObject], Kept], otherwise: Kept) -> tuple[Kept, str]:
    """Returns what `read` makes of the object in a file, or `otherwise` and why the file is none, one line; a file that
    is not there is no fault."""
    try:
        with path.open("rb") as file:
            data = strict_json.loads(file.read(_BYTES_CAP + 1), _BYTES_CAP)
        if not isinstance(data, dict):
            raise FieldError("", described(data), "an object")
        return read(data), ""
    except FileNotFoundError:
        return otherwise, ""
    except (OSError, ValueError) as error:
        return otherwise, f"{path.name}: {error}"


def write_kept_object(path: Path, told: KeptObject, damaged: bool) -> None:
    """Writes the object; a `damaged` file that is there is put aside before.  OSError where that cannot be."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if damaged:
        os.replace(path, path.with_name(f"{path.stem}.damaged{path.suffix}"))
    with replacing(path) as file:
        file.write((json.dumps(told, indent=1, ensure_ascii=False) + "\n").encode("utf-8"))
