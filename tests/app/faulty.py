"""The program with an engine that cannot carry out commands: `python -m faulty`."""

import sys

from app.__main__ import main
from engine.session.session import Session


def broken(*_):
    raise KeyError("missing key")


Session.do = broken

if __name__ == "__main__":
    sys.exit(main())
