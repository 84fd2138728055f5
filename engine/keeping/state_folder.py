"""The user's state folder, where what is to outlive the program lies that is no painting of the user's own."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

import platformdirs


def state_folder(name: str) -> Path:
    """Returns a folder there, made if it is missing, into which nobody else may look.  OSError if that cannot be."""
    folder = platformdirs.user_state_path("inkfall") / name
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    return folder


def key_of(target: Path) -> str:
    """Returns the name under which things about a file lie there.  `target`: its real path."""
    return hashlib.sha256(os.fsencode(target)).hexdigest()[:32]
