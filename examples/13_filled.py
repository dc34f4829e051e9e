"""Filled drawings: visible faces in their parts' colours, flat-shaded, under the lines."""

from pathlib import Path

import hlr

here = Path(__file__).parent
views = {"as1-oc-214.stp": ("iso", 1.0), "nist_ctc_01_asme1_ap242-e1.stp": ("iso-sw", 0.25)}

drawings = []
for model, (view, scale) in views.items():
    drawing = hlr.draw(here / "models" / model, view=view, scale=scale, hidden=False, fill=True)
    drawing.save(here / f"filled-{drawing.view.name}.svg")
    drawings.append(drawing)
