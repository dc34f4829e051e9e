"""An M6 screw with its real thread, lying: `up` turns the paper."""

from pathlib import Path

import hlr

here = Path(__file__).parent
model = here / "models" / "M6-1x12-countersunk-screw.step"

drawing = hlr.draw(model, view=(0.3, -1, 0.5), up=(1, 0, 0.3), scale=10, hidden=False)
drawing.save(here / "screw.svg")
