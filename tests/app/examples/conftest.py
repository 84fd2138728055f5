"""A desk without a window that has the palette of examples."""

import pytest

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.examples import example_state, example_work
from app.desk.files import carried_out
from app.desk.stock import TakeStock
from engine.studio.textures.region_strokes import Regions
from engine.studio.textures.texture_results import RegionScene


@pytest.fixture
def own(tmp_path, monkeypatch):
    monkeypatch.setattr(example_state, "own_folder", lambda: tmp_path / "examples")
    return tmp_path / "examples"


@pytest.fixture
def posted():
    return []


@pytest.fixture
def desk(own, posted):
    made = Desk(View(Place(0, 0, 0), 0, 0.0, 800, 600), posted.append)
    regions = Regions(lambda r: example_work.take_scene(made, r) if isinstance(r, RegionScene) else None)

    def post(request):
        """Regions are painted at once; all else that is asked for is only noted."""
        if type(request) not in regions.handlers:
            posted.append(request)
            return
        regions.handlers[type(request)](request)
        while regions.pending:
            regions.step()

    made.post = post
    made.learn(ready=True)
    made.strip = "examples"
    made.work = lambda work: carried_out(work).arrive(made)
    made.work(TakeStock())
    return made
