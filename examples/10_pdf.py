"""A PDF: a piece of aluminium extrusion at 3:1, in true millimetres on paper."""

from pathlib import Path

import hlr

here = Path(__file__).parent
model = here / "models" / "profile4040.step"

drawing = hlr.draw(model, scale=3)
drawing.save(here / "extrusion.pdf")
