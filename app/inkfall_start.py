"""Starts the installed program: the command `inkfall` is `main` here.

In a wheel this module lies beside the folders `app` and `engine`, whose names others use as well.  It puts the folder
that they lie in first on the path, before what PYTHONPATH names, so that a stranger's `app` is not taken for ours.
"""

from __future__ import annotations

import os
import sys


def main() -> int:
    """Runs the command line; returns the exit status."""
    come_first(os.path.dirname(os.path.abspath(__file__)))
    from app.__main__ import last

    return last()


def come_first(folder: str) -> None:
    """Has `app` and `engine` imported from this folder, by this process and by those that it starts.

    A child that is started with `-m` would look into its working directory before all else: PYTHONSAFEPATH forbids it.
    Where the folder does not hold the program, as in a developer's environment, nothing changes.
    """
    if not os.path.isfile(os.path.join(folder, "app", "__main__.py")):
        return
    sys.path.insert(0, folder)
    others = os.environ.get("PYTHONPATH", "")
    os.environ["PYTHONPATH"] = os.pathsep.join((folder, others)) if others else folder
    os.environ["PYTHONSAFEPATH"] = "1"
