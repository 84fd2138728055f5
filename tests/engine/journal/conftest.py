"""A disk has all the time that it takes: what a test looks at then is there, on however busy a machine."""

import pytest


@pytest.fixture(autouse=True)
def waits_for_the_disk(monkeypatch):
    monkeypatch.setattr("engine.journal.journal.CLOSING", 200.0)
