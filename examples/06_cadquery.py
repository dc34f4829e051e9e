"""A CadQuery script is a source like any other: the same as `hlr draw examples/part.py`."""

from pathlib import Path

import hlr

here = Path(__file__).parent

drawing = hlr.draw(here / "part.py")
drawing.save(here / "cadquery.svg")
