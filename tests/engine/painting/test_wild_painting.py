"""Whatever is asked for, in whatever order: it is done or refused in a line, and what was done is replayed, saved,
recovered and undone exactly."""

import everything
import pytest
import wild
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

QUIET = settings(deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
SESSIONS = st.lists(wild.COMMANDS, min_size=6, max_size=16)


def checked(folder, header, commands):
    everything.pictures(folder)
    wild.Wild(folder, header, commands).check()


@settings(QUIET, max_examples=3)
@given(wild.HEADERS, SESSIONS)
def test_what_was_done_comes_back_as_it_was(tmp_path_factory, header, commands):
    checked(tmp_path_factory.mktemp("wild"), header, commands)


@pytest.mark.nightly
@settings(QUIET, max_examples=60, derandomize=False)
@given(wild.HEADERS, SESSIONS)
def test_other_sessions_every_night(tmp_path_factory, header, commands):
    checked(tmp_path_factory.mktemp("wild"), header, commands)
