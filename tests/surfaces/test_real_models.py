"""Real models, 1920 x 1080: all methods give the same picture. Whole folders: `real_models.py`."""

from pathlib import Path

import pytest
from surfaces.real_models import different

DATA = Path(__file__).resolve().parents[1] / "data"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["M6-1x12-countersunk-screw.step", "soup.stl"])
def test_methods_agree_on_a_real_model(name):
    views = (("iso", None),)
    found = list(different(DATA / name, (1920, 1080), 60.0, views))
    assert len(found) == 8
    assert not [entry for entry in found if entry[2] != 0]
