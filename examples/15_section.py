"""A section among the views of one page: the plane goes through the middle, and bolts and rod stay whole."""

from pathlib import Path

import hlr

here = Path(__file__).parent
model = here / "models" / "as1-oc-214.stp"

options = hlr.Options(section={"front": True}, uncut=("bolt", "rod"))
drawing = hlr.draw_arranged(model, "first-angle", options=options)
drawing.save(here / "section.svg")
