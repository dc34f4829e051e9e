"""Four views of one part at one scale: the model is read and meshed once."""

from pathlib import Path

import hlr

here = Path(__file__).parent
model = here / "models" / "nist_ctc_01_asme1_ap242-e1.stp"

views = ["front", "left", "top", "iso"]
drawings = hlr.draw_views(model, views, hlr.Options(scale=1 / 8))
for drawing in drawings:
    drawing.save(here / f"four_views-{drawing.view.name}.svg")
