"""The command line: `inkfall [FILE]` opens the window, `inkfall COMMAND ...` works without one.

Nothing is imported here before it is known what is wanted: the window's first frame waits for it.
"""

from __future__ import annotations

import gc
import os
import sys

# Command, what it does.  Its module in app.cli, called so or as `arguments.MODULES` says, has declare(parser) and
# run(options) -> int.
COMMANDS = {
    "demo": "play the bundled demo recording, in the window or into pictures",
    "play": "replay a recording without a window",
    "export": "write a painting, or a rectangle of it at any level, as a picture",
    "terrain": "show a painting as land; write its heights as maps and meshes",
    "ground": "make a painting whose land is a height map",
    "film": "make a film of how a painting was made, or of a flight through it",
    "recover": "list, open or discard paintings that were not closed",
    "info": "tell what a painting holds",
    "texture": "make a texture from a spectrum, a sample, a photograph or examples",
    "solid": "show an object of marble, wood, granite, agate or any cube of texture",
    "analyse": "tell what a picture is made of: spectra, colours, regions",
    "bench": "measure against the stated bounds",
    "doctor": "tell what Inkfall finds on this machine",
}


def main(argv: list[str] | None = None) -> int:
    """Does what the arguments say; gives the exit status: 0 done, 1 failed, 2 wrong arguments or input."""
    words = sys.argv[1:] if argv is None else argv
    try:
        status = _dispatch(words)
        sys.stdout.flush()
        return status
    except BaseException as error:
        from app.cli.outcome import reported

        return reported(error)


def _dispatch(words: list[str]) -> int:
    if words and words[0] in COMMANDS:
        from app.cli.arguments import run_command

        return run_command(words[0], words[1:])
    if words and words[0].startswith("-"):
        from app.cli.arguments import run_option

        return run_option(words, COMMANDS)
    return _open_window(words)


def _open_window(words: list[str]) -> int:
    if len(words) > 1 or (words and not os.path.exists(words[0])):
        from app.cli.outcome import Refused

        if len(words) > 1:
            raise Refused(f"found {len(words)} arguments, expected one FILE or a command: {', '.join(COMMANDS)}")
        raise Refused(f"{words[0]}: no such file, and no command: {', '.join(COMMANDS)}")
    try:
        from app.loop import WindowError, run
    except ImportError as error:
        raise _no_window(f"its libraries cannot be loaded: {error}") from None
    try:
        return run(words[0] if words else None)
    except WindowError as error:
        raise _no_window(str(error)) from None


def _no_window(reason: str) -> Exception:
    from app.cli.outcome import Failed

    return Failed(
        f"the window cannot be opened ({reason}); `inkfall doctor` tells more, `inkfall --help` what needs none"
    )


def last() -> int:
    """Does what the command line says as the last work of this process; gives the exit status.

    As a process ends, the interpreter looks for garbage among all that is alive, for 0.3 s; what is frozen it passes
    over.
    """
    status = main()
    gc.freeze()
    return status


if __name__ == "__main__":
    sys.exit(last())
