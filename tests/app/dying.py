"""The program with an engine whose thread ends at the first new layer: `python -m dying`."""

import sys

from app.__main__ import main
from engine.painting.commands import AddLayer
from engine.session.session import Session

DO = Session.do
died = []


def dying(session, command, *more):
    if isinstance(command, AddLayer) and not died:
        died.append(command)
        raise SystemExit("no engine any more")
    return DO(session, command, *more)


Session.do = dying

if __name__ == "__main__":
    sys.exit(main())
