"""The picture of a hard case: compared with the new drawing, or drawn anew on request.

pytest tests/hard --draw        # writes tests/hard/pictures/<case>.svg; look at each before it is committed
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from hlr import Drawing
from support.expected import differences, doubled, ink, read_picture

PICTURES = Path(__file__).with_name("pictures")
LARGEST_PICTURE = 40_000
"""Bytes."""


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--draw", action="store_true", help="draw the pictures of the hard cases anew")


@pytest.fixture
def picture(request: pytest.FixtureRequest) -> Callable[..., None]:
    """picture(drawing): the drawing is the committed pictures/<case>.svg, the case being the name of the test file.

    picture(drawing, "back") is for a second one of the same case. Kinds in `without` need not be in the picture.
    twice: millimetres of ink that may lie on other ink, for outlines of meshes, which run in zigzags along the facets.
    """
    case = request.path.stem.removeprefix("test_")

    def compare(
        drawing: Drawing,
        which: str = "",
        *,
        without: Sequence[str] = (),
        step: float | None = None,
        twice: float = 0.0,
    ) -> None:
        path = PICTURES / f"{case}{which and '-'}{which}.svg"
        if request.config.getoption("--draw", default=False):
            PICTURES.mkdir(exist_ok=True)
            drawing.save(path)
        assert path.exists(), f"no picture {path.name}: pytest tests/hard --draw makes it, then look at it"
        assert path.stat().st_size <= LARGEST_PICTURE
        used = drawing.accuracy.used
        told = differences(read_picture(path), ink(drawing), used, step, judged=ink(drawing, without))
        assert not told, f"not as in {path.name}:\n" + "\n".join(told)
        assert doubled(drawing) <= twice

    return compare
