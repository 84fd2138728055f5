"""What this program is called among all that ever ran: by that, what it leaves in several places is known to be its."""

from __future__ import annotations

import secrets
from functools import cache


@cache
def program_ident() -> str:
    """Returns a name that no other process has or had, whatever numbers the system gives again; children that are
    forked off after the first call share it."""
    return secrets.token_hex(8)
